"""Statistics that tell bias from noise in images rendered several times with different seeds.

The reference is a mean image with the variance of that mean. Its channels are taken as fully correlated, as
they nearly are where one path carries all of them. Needs numpy.
"""
import math
from statistics import NormalDist

import numpy as np

TRIM = 0.001            # share of the worst pixels left out of the error, as in `duet compare`
SIGNIFICANCE = 0.01     # of all tiles together
LARGEST_DF = 1000       # beyond, Student's distribution is taken as that with so many degrees


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


def student_p(t, df, steps=20000):
    """Probability that |Student's t| with `df` degrees of freedom is above |t|: with t = √df tan θ its density
    becomes proportional to cos^(df − 1) θ."""
    df = np.minimum(df, LARGEST_DF)[..., None]
    middle = (np.arange(steps) + 0.5) / steps
    def above(start):
        width = math.pi / 2 - start
        return (np.cos(start + width * middle) ** (df - 1)).mean(axis=-1) * width[..., 0]
    return above(np.arctan(np.abs(t)[..., None] / np.sqrt(df))) / above(np.zeros_like(df))


def welch(samples, expected, expected_variance):
    """Differences of the means of `samples` along axis 0 from what is expected, their standard errors, and
    the p-values of Welch's t-test. The expected values' variance is taken as known."""
    own = samples.var(axis=0, ddof=1) / len(samples)
    both = own + expected_variance
    df = np.maximum((both / np.maximum(own, 1e-300)) ** 2 * (len(samples) - 1), 1.0)
    difference = samples.mean(axis=0) - expected
    return difference, np.sqrt(both), student_p(difference / np.sqrt(both), df)


def tile_means(grey, tiles):
    height, width = grey.shape[-2] // tiles, grey.shape[-1] // tiles
    blocks = grey.reshape(grey.shape[:-2] + (tiles, height, tiles, width))
    return blocks.mean(axis=(-3, -1))


def judge(images, reference, tiles=8):
    """Bias of the whole image and of each of tiles × tiles parts of it, from independent images."""
    grey = np.stack([image.mean(axis=2) for image in images])
    expected = reference.mean.mean(axis=2)
    difference, error, _ = welch(tile_means(grey, 1), tile_means(expected, 1),
                                 tile_means(reference.grey_variance, 1) / expected.size)
    parts = tile_means(expected, tiles)
    part_difference, _, p = welch(tile_means(grey, tiles), parts,
                                  tile_means(reference.grey_variance, tiles) * tiles ** 2 / expected.size)
    z2 = [NormalDist().inv_cdf(max(x / 2, 1e-300)) ** 2 for x in p.ravel()]
    rejected = p < 1 - (1 - SIGNIFICANCE) ** (1 / p.size)
    relative = (part_difference / parts)[rejected]
    mean = expected.mean()
    return {'bias': float(difference.item() / mean), 'error': float(error.item() / mean),
            'tiles': p.size, 'rejected': int(rejected.sum()), 'mean_z2': float(np.mean(z2)),
            'lowest': float(relative.min()) if relative.size else None,
            'highest': float(relative.max()) if relative.size else None}
