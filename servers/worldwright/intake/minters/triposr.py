"""TripoSR's own Gradio app: the background is removed there, and a mesh with coloured corners made, GLB or OBJ.

Written after its `gradio_app.py`; no real server was reached from here, only stand-ins, and Gradio's own server with functions of its
names.
"""

from ..gradio_session import Session, handed_on
from ..orders import Order, Terms
from ..web_calls import Server

TERMS = Terms(
    "WORLDWRIGHT_TRIPOSR", "start TripoSR's gradio_app.py (port 7860), then name it: --address http://127.0.0.1:7860"
)


def mint(picture: bytes, server: Server, order: Order) -> bytes:
    """The GLB or OBJ that it makes of a picture.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    app = Session(server, order.hears)
    given = app.upload(picture)
    cut = handed_on(app.ask(("preprocess",), image=given)) or given
    return app.file(app.ask(("generate",), image=cut), (".glb", ".obj"))
