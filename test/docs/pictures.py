"""Compares two pictures of talus draw as a reader sees them: pixel by pixel, but for the words, whose font is the machine's."""
import struct
import zlib

MAX_SIZE_DIFFERENCE = 0.1  # another font makes a legend wrap
HEAD, FOOT = 64, 62        # pixels: title and legend, draw_sheet.c
MAX_CHANGED = 0.003        # of the pixels: the scale's length in words
VISIBLE = 32               # of 255


def unpack_png(path):
    """(width, height, bytes a pixel, filtered rows): PNG (second edition), 8 bits a channel, not interlaced, as talus writes them."""
    data = open(path, "rb").read()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path} is no PNG")
    place, packed = 8, b""
    while place < len(data):
        size, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            if depth != 8 or interlace or colour not in (0, 2, 6):
                raise ValueError(f"{path}: {depth} bits, colour type {colour}, interlace {interlace}")
            step = {0: 1, 2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            packed += body
        place += size + 12
    return width, height, step, zlib.decompress(packed)


def paeth(left, above, corner):
    estimate = left + above - corner
    a, b, c = abs(estimate - left), abs(estimate - above), abs(estimate - corner)
    return left if a <= b and a <= c else above if b <= c else corner


def unfilter(data, width, height, step):
    rows, above = [], bytearray(width)
    for y in range(height):
        kind = data[y * (width + 1)]
        row = bytearray(data[y * (width + 1) + 1:(y + 1) * (width + 1)])
        if kind == 1:
            for i in range(step, width):
                row[i] = (row[i] + row[i - step]) & 255
        elif kind == 2:
            row = bytearray((value + up) & 255 for value, up in zip(row, above))
        elif kind == 3:
            for i in range(width):
                row[i] = (row[i] + ((row[i - step] if i >= step else 0) + above[i]) // 2) & 255
        elif kind == 4:
            for i in range(width):
                left, corner = (row[i - step], above[i - step]) if i >= step else (0, 0)
                row[i] = (row[i] + paeth(left, above[i], corner)) & 255
        rows.append(row)
        above = row
    return rows


def differ(one, other):
    """What tells two pictures apart, in words; None where a reader sees none of it."""
    picture, other_picture = unpack_png(one), unpack_png(other)
    if picture == other_picture:
        return None
    (width, height, step, filtered), (width2, height2, step2, filtered2) = picture, other_picture
    if step != step2 or abs(width - width2) > MAX_SIZE_DIFFERENCE * width or abs(height - height2) > MAX_SIZE_DIFFERENCE * height:
        return f"{width} x {height} and {width2} x {height2} pixels"
    rows = unfilter(filtered, width * step, height, step)
    rows2 = unfilter(filtered2, width2 * step, height2, step)
    size = min(width, width2) * step
    changed = total = 0
    for a, b in zip(rows[HEAD:-FOOT], rows2[HEAD:-FOOT]):
        total += size // step
        if a[:size] != b[:size]:
            changed += len({i // step for i in range(size) if abs(a[i] - b[i]) > VISIBLE})
    return f"{changed} of {total} pixels differ" if changed > MAX_CHANGED * total else None
