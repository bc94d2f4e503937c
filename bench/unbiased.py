"""Statistics that tell bias from noise in images rendered several times with different seeds.

The reference is a mean image with the variance of that mean. Its channels are taken as fully correlated, as
they nearly are where one path carries all of them. Needs numpy; the tests also the
Python package (docs/python.md).
"""
import numpy as np

TRIM = 0.001            # share of the worst pixels left out of the error, as in `duet compare`
SIGNIFICANCE = 0.01     # of all tiles together


class Reference:
    def __init__(self, mean, variance_of_mean):
        self.mean, self.variance = mean, variance_of_mean
        self.grey_variance = np.sqrt(variance_of_mean).mean(axis=2) ** 2


def trimmed_relmse(image, reference):
    """Mean of (a − b)² / (b² + 0.01) without the worst pixels, less what the reference's noise adds."""
    scale = 1 / (reference.mean ** 2 + 0.01)
    error = ((image - reference.mean) ** 2 * scale).mean(axis=2).ravel()
    kept = np.argsort(error)[:int(len(error) * (1 - TRIM))]
    return float(error[kept].mean() - (reference.variance * scale).mean(axis=2).ravel()[kept].mean())


def welch(samples, expected, expected_variance):
    """Welch's tests of the means of `samples` along axis 0 against what is expected, whose variance is known."""
    import duet  # what measures errors only does without the package
    columns = samples.reshape(len(samples), -1).T
    return [duet.welch(*column) for column in zip(columns, expected.ravel(), expected_variance.ravel())]


def tile_means(grey, tiles):
    height, width = grey.shape[-2] // tiles, grey.shape[-1] // tiles
    blocks = grey.reshape(grey.shape[:-2] + (tiles, height, tiles, width))
    return blocks.mean(axis=(-3, -1))


def judge(images, reference, tiles=8):
    """Bias of the whole image and of each of tiles × tiles parts of it, from independent images."""
    grey = np.stack([image.mean(axis=2) for image in images])
    expected = reference.mean.mean(axis=2)
    whole, = welch(tile_means(grey, 1), tile_means(expected, 1), tile_means(reference.grey_variance, 1) / expected.size)
    parts = tile_means(expected, tiles)
    tests = welch(tile_means(grey, tiles), parts, tile_means(reference.grey_variance, tiles) * tiles ** 2 / expected.size)
    level = 1 - (1 - SIGNIFICANCE) ** (1 / len(tests))
    relative = [t.difference / part for t, part in zip(tests, parts.ravel()) if t.p < level]
    mean = expected.mean()
    return {'bias': float(whole.difference / mean), 'error': float(whole.error / mean),
            'tiles': len(tests), 'rejected': len(relative), 'mean_z2': float(np.mean([t.z ** 2 for t in tests])),
            'lowest': float(min(relative)) if relative else None,
            'highest': float(max(relative)) if relative else None}
