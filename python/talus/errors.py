# SPDX-License-Identifier: MIT
"""Errors of the package."""

from __future__ import annotations

from . import _talus


class Error(ValueError):
    """What a talus function refuses or cannot do.

    Running out of memory is a `MemoryError`, and Ctrl-C during a bake a `KeyboardInterrupt`, as everywhere in Python.
    """

    result: str
    """The result's name in the C library, such as ``TL_ERR_NOT_FINITE``."""
    stage: str
    """The stage of a bake that failed, or an empty string."""
    field: str | None
    """The setting that was refused, such as ``cell_size``."""
    element: str | None
    """The kind of the offending element: ``vertex``, ``triangle``, ``contour`` ..."""
    element_index: int | None
    """Its index in what was given."""
    advice: str | None
    """What to do about it."""

    def __init__(
        self,
        result: str,
        text: str,
        stage: str = "",
        field: str | None = None,
        element: str | None = None,
        element_index: int | None = None,
        advice: str | None = None,
    ) -> None:
        words = text
        if field:
            words += f" ({field})"
        if element:
            words += f" ({element}" + (f" {element_index})" if element_index is not None else ")")
        if advice:
            words += f": {advice}"
        super().__init__(words)
        self.result = result
        self.stage = stage
        self.field = field
        self.element = element
        self.element_index = element_index
        self.advice = advice


_talus.set_error_class(Error)
