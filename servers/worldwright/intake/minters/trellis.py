"""TRELLIS's own Gradio app (Microsoft, 1 and 2): the background is removed there, a mesh made, and a GLB taken from it.

Written after its `app.py`; no real server was reached from here, only stand-ins, and Gradio's own server with functions of its names.
"""

from ..gradio_session import Session, handed_on
from ..orders import Order, Terms
from ..web_calls import Server

TERMS = Terms(
    "WORLDWRIGHT_TRELLIS", "start TRELLIS's app.py (port 7860), then name it: --address http://127.0.0.1:7860"
)


def mint(picture: bytes, server: Server, order: Order) -> bytes:
    """The textured GLB that it makes of a picture.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    app = Session(server, order.hears)
    if app.has("start_session"):  # makes the folder into which the others write
        app.ask(("start_session",))
    given = app.upload(picture)
    cut = handed_on(app.ask(("preprocess_image",), image=given)) or given
    app.ask(("image_to_3d",), image=cut)
    return app.file(app.ask(("extract_glb", "extract_mesh")), (".glb",))
