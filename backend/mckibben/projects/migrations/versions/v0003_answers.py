"""Finished diagnoses in projects."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the table."""
    op.create_table(
        "project_answers",
        sa.Column("project", sa.String(32), nullable=False),
        sa.Column("name", sa.String(64), nullable=False),
        sa.Column("saved", sa.BigInteger(), nullable=False),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.ForeignKeyConstraint(
            ["project"], ["projects.id"], name="fk_project_answers_project", ondelete="CASCADE"
        ),
        sa.ForeignKeyConstraint(["digest"], ["contents.digest"], name="fk_project_answers_digest"),
        sa.PrimaryKeyConstraint("project", "name", name="pk_project_answers"),
    )
    op.create_index("ix_project_answers_digest", "project_answers", ["digest"])


def downgrade() -> None:
    """Remove the table, with all diagnoses of projects."""
    op.drop_table("project_answers")
