#include "math/sobol.h"

#include "base/instruction_sets.h"

namespace duet::sobol_detail {
namespace {

/// Degree, inner coefficients and initial numbers of the primitive polynomials of dimensions 2
/// … 16. Source: Joe & Kuo, "Constructing Sobol Sequences with Better Two-Dimensional Projections",
/// SIAM J. Sci. Comput. 30(5), 2008, table "new-joe-kuo-6".
struct Polynomial {
  int degree;
  uint32_t coefficients;
  std::array<uint32_t, 6> initial;
};
constexpr std::array<Polynomial, kSobolDimensions - 1> kPolynomials{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
}};

/// The direction numbers of one dimension as 32-bit fractions.
constexpr std::array<uint32_t, kSobolIndexBits> direction_numbers(int dimension) {
  std::array<uint32_t, kSobolIndexBits> v{};
  if (dimension == 0) {
    for (int i = 0; i < kSobolIndexBits; ++i) v[i] = 0x80000000u >> i;
    return v;
  }
  const Polynomial& p = kPolynomials[dimension - 1];
  for (int i = 0; i < kSobolIndexBits; ++i) {
    if (i < p.degree) {
      v[i] = p.initial[i] << (31 - i);
      continue;
    }
    v[i] = v[i - p.degree] ^ (v[i - p.degree] >> p.degree);
    for (int k = 1; k < p.degree; ++k)
      if ((p.coefficients >> (p.degree - 1 - k)) & 1) v[i] ^= v[i - k];
  }
  return v;
}

constexpr Table make_rows() {
  Table rows{};
  for (int d = 0; d < kSobolDimensions; ++d) {
    const auto v = direction_numbers(d);
    for (int byte = 0; byte < 2; ++byte)
      for (int value = 0; value < 256; ++value) {
        uint32_t x = 0;
        for (int bit = 0; bit < 8; ++bit)
          if ((value >> bit) & 1) x ^= v[8 * byte + bit];
        rows[byte][value][d] = reverse_bits(x);
      }
  }
  return rows;
}

}  // namespace

constinit const Table kRows = make_rows();

}  // namespace duet::sobol_detail

namespace duet {

DUET_WIDE void scramble_group(const SobolRow& row, uint32_t key, uint32_t first, float* numbers) {
  const uint32_t *const low = row.low + first % kSobolDimensions, *const high =
                                                                      row.high +
                                                                      first % kSobolDimensions;
  for (uint32_t i = 0; i < kSobolGroup; ++i) {
    const uint32_t seed = scramble_seed(key, first + i);
    numbers[i] = to_unit_float(owen_scramble_reversed(low[i] ^ high[i], seed));
  }
}

}  // namespace duet
