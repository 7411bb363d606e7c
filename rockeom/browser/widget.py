"""A page as a widget of a notebook, whose values stay in step with Python."""

from collections.abc import Callable
from importlib.resources import files
from typing import Any

from rockeom.browser.controls import Controls
from rockeom.simulation.case import Case


def widget_of(title: str, html: str, controls: Controls, function: Callable[..., Case]) -> Any:
    """A widget of a page of a case, a function of the controls.

    Its class is made here, since it derives from one of the extra, anywidget.
    """
    try:
        import anywidget
        import traitlets
    except ImportError as error:
        raise ImportError(
            "a widget of a page needs the package anywidget: pip install anywidget, or "
            'pip install -e ".[widget]"; without it the page itself is shown'
        ) from error

    class PageWidget(anywidget.AnyWidget):
        """A page, with `values` of its sliders and menus by name, and the `case` at them."""

        _esm = files("rockeom").joinpath("browser", "assets", "widget.js").read_text("utf-8")
        title = traitlets.Unicode().tag(sync=True)
        page = traitlets.Unicode().tag(sync=True)
        values = traitlets.Dict().tag(sync=True)

        @traitlets.validate("values")
        def _complete(self, proposal: Any) -> dict[str, Any]:
            """The values with those that are not named as they were."""
            controls.places("values", proposal["value"])
            return {**self.values, **proposal["value"]}

        @property
        def case(self) -> Case:
            """The case at the present values."""
            return function(**controls.arguments(self.values))

    return PageWidget(title=title, page=html, values=controls.labelled())
