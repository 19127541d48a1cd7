"""Generated requests over the whole OpenAPI document: no 5xx, and every answer is the one declared.

The seed is fixed: the same requests every run. Among the checks is that what the document forbids is refused;
the reverse (what it allows is accepted) does not hold for texts with units, whose grammar no JSON schema says.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, seed, settings
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    negative_data_rejection,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
    unsupported_method,
)
