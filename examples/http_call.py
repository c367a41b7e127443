"""The HTTP API with the standard library only: python http_call.py [address of a running server]."""

import json
import sys
import urllib.error
import urllib.request

address = sys.argv[1] if len(sys.argv) > 1 else "http://127.0.0.1:8000"
body = {"kind": "simulation", "activation": {"ct": 0.8}, "run": {"duration_s": 0.5}}
request = urllib.request.Request(
    f"{address}/api/v1/simulate",
    data=json.dumps(body).encode(),
    headers={"Content-Type": "application/json"},
)
try:
    with urllib.request.urlopen(request, timeout=60) as answer:
        result = json.load(answer)
except urllib.error.HTTPError as error:  # an RFC 9457 problem: what is wrong, where, and what is allowed
    sys.exit(json.dumps(json.load(error), indent=2))

print(result["phonation_state"])
for key in ("fo_hz", "closed_quotient", "spl_30cm_db"):
    measure = result["measures"][key]  # a value, or null and the reason
    print(f"{key}: {measure['reason'] if measure['value'] is None else measure['value']} {measure['unit']}")
