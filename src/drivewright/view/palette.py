"""Colours by role, once, for the figures, the report's style sheet and the player.

Each role is (on light ground, on dark ground).  The five part colours stay apart for the common kinds of colour
blindness and on a grey printer differ in lightness where hue alone would not do; a test simulates both.
"""

ROLES = {
    "page": ("#f4f6f8", "#0e1216"),
    "surface": ("#ffffff", "#171c22"),
    "canvas": ("#fbfcfe", "#12161c"),
    "raised": ("#eef1f4", "#222932"),
    "line": ("#dde2e8", "#2b333d"),
    "grid": ("#e9edf1", "#20272f"),
    "grid-strong": ("#d5dce3", "#303944"),
    "ink": ("#1a222c", "#e8edf2"),
    "muted": ("#5b6775", "#9aa6b4"),
    "accent": ("#1b55bd", "#7aa8ff"),
    "cursor": ("#c2410c", "#ff9a62"),
    "good": ("#0b7261", "#45d0b0"),
    "good-soft": ("#e4f3ef", "#12302b"),
    "bad": ("#b3261e", "#ff8a7d"),
    "bad-soft": ("#fbe9e7", "#3a1c1a"),
    "warn": ("#8a5300", "#f4bd5c"),
    "warn-soft": ("#fdf2dc", "#35290f"),
    "steel": ("#474d58", "#848e99"),
    "blue": ("#1b55bd", "#5a90f4"),
    "orange": ("#e5630a", "#f3922b"),
    "green": ("#2b9a80", "#67e3ae"),
    "violet": ("#b261dc", "#d8a6fb"),
    "ground": ("#2f3742", "#c3ccd6"),
}
SERIES = ("blue", "orange", "green", "violet", "steel")
MARKERS = ("o", "s", "X", "D", "^", "P", "v")  # of groups of points; seven beside five colours make 35 pairs
TRACES = ("violet", "orange", "green", "blue", "steel")
THEMES = ("light", "dark")
COLOUR_MAP = "viridis"  # of fields on surfaces: even to the eye, and on a grey printer
BARE = "#b8b8b8"  # where a field was not evaluated


def colour(role: str, theme: str = "light") -> str:
    """Hex colour of a role; an unknown role of a scene is drawn as steel."""
    return ROLES.get(role, ROLES["steel"])[THEMES.index(theme)]


def declarations(theme: str) -> str:
    """The roles as custom properties of a style sheet: `--blue: #1b55bd; ...`."""
    return " ".join(f"--{role}: {colour(role, theme)};" for role in ROLES)


def style_sheet() -> str:
    """Rules that set every role for both themes: by the reader's preference, or forced with data-theme on the root element."""
    light, dark = (declarations(theme) for theme in THEMES)
    return (
        f":root {{ color-scheme: light; {light} }}\n"
        f"@media screen and (prefers-color-scheme: dark) {{ :root:not([data-theme=light]) {{ color-scheme: dark; {dark} }} }}\n"
        f"@media screen {{ :root[data-theme=dark] {{ color-scheme: dark; {dark} }} }}\n"
    )


def colour_stops(count: int = 33) -> list[str]:
    """`count` colours of the map in which fields are drawn, as #rrggbb, evenly from its lowest to its highest."""
    from matplotlib import colormaps
    from matplotlib.colors import to_hex

    return [to_hex(colormaps[COLOUR_MAP](n / (count - 1))) for n in range(count)]
