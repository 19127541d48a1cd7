"""Figures as a notebook keeps them: in a page made of it they are there, without a connection."""

from __future__ import annotations

from typing import Any, ClassVar

from plotly.graph_objects import Figure

_PLOTLY = "application/vnd.plotly.v1+json"


class ShownFigure(Figure):
    """A Plotly figure whose HTML needs nothing from elsewhere.

    A notebook that is executed and converted shows what it holds: beside Plotly's own form, which notebooks
    draw while they are open, there is HTML. The first figure that is shown brings the script for all.
    """

    _has_script: ClassVar[bool] = False

    def _repr_mimebundle_(self, *_: Any, **__: Any) -> dict[str, Any]:
        script = not ShownFigure._has_script
        ShownFigure._has_script = True
        return {_PLOTLY: self.to_plotly_json(), "text/html": self._html(script)}

    def _repr_html_(self) -> str:
        return self._html(True)

    def _html(self, script: bool) -> str:
        return self.to_html(include_plotlyjs=script, full_html=False, config={"displayModeBar": False})

    def _ipython_display_(self) -> None:
        from IPython.display import display  # type: ignore - whoever calls this has it

        display(self._repr_mimebundle_(), raw=True)
