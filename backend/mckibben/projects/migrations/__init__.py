"""Migrations of the projects' database, run by Alembic."""
