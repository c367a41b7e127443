"""Numbers as the text of a JSON list, with a fixed count of decimals: the pictures of a played voice.

Python finds the shortest text that reads back as the same double, number by number, which for the hundreds of numbers
of a picture takes longer than the step that made them. Here they are whole multiples of the last decimal place.
"""

from vfcore.kernels.jit import jit

MINUS, POINT, ZERO, COMMA, OPEN, CLOSE = (ord(sign) for sign in "-.0,[]")
#: Octets for one number and its comma: sign, 15 digits before the point, the point, 15 after it; or "null".
ROOM = 33
LARGEST = 1e15


@jit
def write_decimals(values, factor, decimals, out):
    """Write ``values`` (n,) times ``factor`` as a list with ``decimals`` (0 to 15); return how many octets it took.

    ``out`` (n·ROOM + 2,) uint8. What is not finite, or too large for whole multiples (LARGEST of them), becomes null.
    """
    scale = factor
    for _ in range(decimals):
        scale *= 10.0
    out[0] = OPEN
    at = 1
    for k in range(values.size):
        if k > 0:
            out[at] = COMMA
            at += 1
        scaled = values[k] * scale
        if not abs(scaled) < LARGEST:
            for letter in (110, 117, 108, 108):  # null
                out[at] = letter
                at += 1
            continue
        left = int(abs(scaled) + 0.5)
        if scaled < 0.0 and left > 0:
            out[at] = MINUS
            at += 1
        digits, rest = 1, left // 10
        while rest > 0:
            digits, rest = digits + 1, rest // 10
        digits = max(digits, decimals + 1)  # a zero before the point
        end = at + digits + (1 if decimals > 0 else 0)
        place = end - 1
        for d in range(digits):
            if d == decimals and d > 0:
                out[place] = POINT
                place -= 1
            out[place] = ZERO + left % 10
            left //= 10
            place -= 1
        at = end
    out[at] = CLOSE
    return at + 1
