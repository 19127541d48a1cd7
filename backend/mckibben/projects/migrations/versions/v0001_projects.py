"""Projects, their revisions and files."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the tables."""
    op.create_table(
        "projects",
        sa.Column("id", sa.String(32), nullable=False),
        sa.Column("title", sa.String(200), nullable=False),
        sa.Column("notes", sa.Text(), nullable=False),
        sa.Column("version", sa.BigInteger(), nullable=False),
        sa.Column("created", sa.BigInteger(), nullable=False),
        sa.Column("changed", sa.BigInteger(), nullable=False),
        sa.Column("deleted", sa.BigInteger(), nullable=True),
        sa.PrimaryKeyConstraint("id", name="pk_projects"),
    )
    op.create_index("ix_projects_changed", "projects", ["changed"])
    op.create_table(
        "revisions",
        sa.Column("project", sa.String(32), nullable=False),
        sa.Column("version", sa.BigInteger(), nullable=False),
        sa.Column("saved", sa.BigInteger(), nullable=False),
        sa.Column("label", sa.String(200), nullable=False),
        sa.Column("automatic", sa.Boolean(), nullable=False),
        sa.Column("document", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(
            ["project"], ["projects.id"], name="fk_revisions_project", ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("project", "version", name="pk_revisions"),
    )
    op.create_table(
        "contents",
        sa.Column("digest", sa.String(64), nullable=False),
        sa.Column("data", sa.LargeBinary(), nullable=False),
        sa.PrimaryKeyConstraint("digest", name="pk_contents"),
    )
    op.create_table(
        "project_files",
        sa.Column("project", sa.String(32), nullable=False),
        sa.Column("measurement", sa.String(64), nullable=False),
        sa.Column("name", sa.String(200), nullable=False),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.Column("mapping", sa.Text(), nullable=True),
        sa.ForeignKeyConstraint(
            ["project"], ["projects.id"], name="fk_project_files_project", ondelete="CASCADE"
        ),
        sa.ForeignKeyConstraint(["digest"], ["contents.digest"], name="fk_project_files_digest"),
        sa.PrimaryKeyConstraint("project", "measurement", name="pk_project_files"),
    )
    op.create_index("ix_project_files_digest", "project_files", ["digest"])


def downgrade() -> None:
    """Remove the tables, with all projects."""
    for table in ("project_files", "contents", "revisions", "projects"):
        op.drop_table(table)
