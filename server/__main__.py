"""``python -m vocalis.server``: serve, or with ``--warm`` only compile the kernels (for images)."""

import argparse
import sys

from vocalis.server.serve import read_settings, serve
from vocalis.server.warmup.compile import compile_everything, compile_forms


def main() -> None:
    """Read the options; defaults come from the environment (VOCALIS_*)."""
    default = read_settings()
    parser = argparse.ArgumentParser(prog="python -m vocalis.server", description=__doc__)
    parser.add_argument("--host", default=default.host, help="address to listen on (default %(default)s)")
    parser.add_argument("--port", type=int, default=default.port, help="port (default %(default)s); 0: any free one")
    parser.add_argument("--token", help="token that every request needs; generated on a public address when left out")
    parser.add_argument("--tls-cert", help="certificate file (PEM)")
    parser.add_argument("--tls-key", help="key file (PEM)")
    parser.add_argument("--warm", action="store_true", help="compile the kernels into the cache and exit")
    options = parser.parse_args()
    if options.warm:
        compile_everything()
        compile_forms()
        sys.exit()
    serve(options.host, options.port, options.token, options.tls_cert, options.tls_key)


if __name__ == "__main__":
    main()
