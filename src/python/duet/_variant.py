"""Variants: Duet has one, and programs that were written for Mitsuba 3 ask for it."""


def variant() -> str:
    """What Duet is in Mitsuba 3's words: it renders linear RGB."""
    return "scalar_rgb"


def variants() -> list[str]:
    """All that Duet is in Mitsuba 3's words."""
    return [variant()]


def set_variant(*names: str) -> None:
    """Does nothing if one of the names is a variant of Mitsuba 3 that renders linear RGB, such as "llvm_ad_rgb", whose
    images are the same. Raises ValueError for others: Duet has neither spectra, polarisation nor images without colours.
    """
    for given in names:
        if not isinstance(given, str):
            raise TypeError(f"a variant is a str, not {type(given).__name__}")
    if not any(name.split("_")[-1] == "rgb" for name in names):
        raise ValueError(f"{', '.join(names) or 'no variant'}: Duet renders linear RGB, as Mitsuba's variants *_rgb do")
