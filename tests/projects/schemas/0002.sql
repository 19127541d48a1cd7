BEGIN TRANSACTION;
CREATE TABLE alembic_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "alembic_version" VALUES('0002');
CREATE TABLE contents (
	digest VARCHAR(64) NOT NULL, 
	data BLOB NOT NULL, 
	CONSTRAINT pk_contents PRIMARY KEY (digest)
);
INSERT INTO "contents" VALUES('4035f8181ff1c0b845c57709f820b05a44497a07afb6b97626e5e34d51399067',X'23206B696E643A207374617469630A70726573737572655F6261723B6C656E6774685F6D6D3B666F7263655F4E0A313B3238303B3132380A313B3239303B3132390A323B3238303B3232380A');
INSERT INTO "contents" VALUES('1230866332cec9c420cca3a52e03d591cd73c68bf5459bef98745ed015a60c9f',X'686561640A746872656520726F77730A');
CREATE TABLE project_files (
	project VARCHAR(32) NOT NULL, 
	measurement VARCHAR(64) NOT NULL, 
	name VARCHAR(200) NOT NULL, 
	digest VARCHAR(64) NOT NULL, 
	mapping TEXT, 
	CONSTRAINT pk_project_files PRIMARY KEY (project, measurement), 
	CONSTRAINT fk_project_files_project FOREIGN KEY(project) REFERENCES projects (id) ON DELETE CASCADE, 
	CONSTRAINT fk_project_files_digest FOREIGN KEY(digest) REFERENCES contents (digest)
);
INSERT INTO "project_files" VALUES('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa','4035f8181ff1c0b845c57709f820b05a44497a07afb6b97626e5e34d51399067','map.csv','4035f8181ff1c0b845c57709f820b05a44497a07afb6b97626e5e34d51399067',NULL);
CREATE TABLE project_studies (
	project VARCHAR(32) NOT NULL, 
	study VARCHAR(64) NOT NULL, 
	environment VARCHAR(64) NOT NULL, 
	runs BIGINT NOT NULL, 
	saved BIGINT NOT NULL, 
	digest VARCHAR(64) NOT NULL, 
	CONSTRAINT pk_project_studies PRIMARY KEY (project, study), 
	CONSTRAINT fk_project_studies_project FOREIGN KEY(project) REFERENCES projects (id) ON DELETE CASCADE, 
	CONSTRAINT fk_project_studies_digest FOREIGN KEY(digest) REFERENCES contents (digest)
);
INSERT INTO "project_studies" VALUES('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa','cccccccccccccccccccccccccccccccc','dddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddd',3,1600000000000,'1230866332cec9c420cca3a52e03d591cd73c68bf5459bef98745ed015a60c9f');
CREATE TABLE projects (
	id VARCHAR(32) NOT NULL, 
	title VARCHAR(200) NOT NULL, 
	notes TEXT NOT NULL, 
	version BIGINT NOT NULL, 
	created BIGINT NOT NULL, 
	changed BIGINT NOT NULL, 
	deleted BIGINT, 
	CONSTRAINT pk_projects PRIMARY KEY (id)
);
INSERT INTO "projects" VALUES('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa','Lift','a note',2,1600000000000,1600000060000,NULL);
INSERT INTO "projects" VALUES('bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb','In the bin','',1,1600000000000,1600000000000,1600000070000);
CREATE TABLE revisions (
	project VARCHAR(32) NOT NULL, 
	version BIGINT NOT NULL, 
	saved BIGINT NOT NULL, 
	label VARCHAR(200) NOT NULL, 
	automatic BOOLEAN NOT NULL, 
	document TEXT NOT NULL, 
	CONSTRAINT pk_revisions PRIMARY KEY (project, version), 
	CONSTRAINT fk_revisions_project FOREIGN KEY(project) REFERENCES projects (id) ON DELETE CASCADE
);
INSERT INTO "revisions" VALUES('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',1,1600000000000,'saved',0,'{"step":1}');
INSERT INTO "revisions" VALUES('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',2,1600000000000,'saved',0,'{"case": "4035f8181ff1c0b845c57709f820b05a44497a07afb6b97626e5e34d51399067"}');
INSERT INTO "revisions" VALUES('bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb',1,1600000000000,'saved',0,'{}');
CREATE INDEX ix_projects_changed ON projects (changed);
CREATE INDEX ix_project_files_digest ON project_files (digest);
CREATE INDEX ix_project_studies_digest ON project_studies (digest);
COMMIT;
