"""Tables of studies in projects."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create the table."""
    op.create_table(
        "project_studies",
        sa.Column("project", sa.String(32), nullable=False),
        sa.Column("study", sa.String(64), nullable=False),
        sa.Column("environment", sa.String(64), nullable=False),
        sa.Column("runs", sa.BigInteger(), nullable=False),
        sa.Column("saved", sa.BigInteger(), nullable=False),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.ForeignKeyConstraint(
            ["project"], ["projects.id"], name="fk_project_studies_project", ondelete="CASCADE"
        ),
        sa.ForeignKeyConstraint(["digest"], ["contents.digest"], name="fk_project_studies_digest"),
        sa.PrimaryKeyConstraint("project", "study", name="pk_project_studies"),
    )
    op.create_index("ix_project_studies_digest", "project_studies", ["digest"])


def downgrade() -> None:
    """Remove the table, with all study tables of projects."""
    op.drop_table("project_studies")
