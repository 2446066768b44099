"""Numbers and sentences for people, as dmpc writes them."""

_TIMES = (("s", 1), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9))


def counted(count, thing):
    """1,024 nodes; 1 node."""
    return f"{count:,} {thing}{'' if count == 1 else 's'}"


def bytes_text(count):
    """300 B, 1.5 KiB, 3.21 MiB."""
    return f"{count} B" if count < 1 << 10 else f"{count / (1 << 10):.1f} KiB" if count < 1 << 20 else f"{count / (1 << 20):.2f} MiB"


def time_text(seconds):
    """With three significant digits: 3.10 ms, 26.9 s."""
    unit, size = next(((unit, size) for unit, size in _TIMES if seconds >= size), _TIMES[-1])
    value = seconds / size
    is_whole = unit == "ns" and abs(value - round(value)) < 1e-9 * max(1, abs(value))
    return f"{value:,.{0 if is_whole or value >= 100 or value == 0 else 1 if value >= 10 else 2 if value >= 1 else 3}f} {unit}"


def folded(text, width, indent="  "):
    """The words of a text in lines of at most `width` letters, none but the first of which begins as an item of Markdown does."""
    lines, line = [], ""
    for word in _words(text):
        if line.strip() and len(line) + 1 + len(word) <= width:
            line += " " + word
        else:
            lines += [line] if line else []
            line = (indent if line else "") + word
    return "\n".join([*lines, line])


def _words(text):
    """Each with those behind it that must not begin a line."""
    words = []
    for word in text.split():
        if words and (word[0] in "-+*#>=" or (word[-1] == "." and not word.strip("0123456789."))):
            words[-1] += " " + word
        else:
            words.append(word)
    return words
