// Made by scripts/make_color_tables.py from Mitsuba 3.9.1; do not edit.
//
// Source: the measurements data/ior/*.spd of Mitsuba, Copyright (c) Wenzel Jakob and others,
// BSD-3-Clause; the files name luxpop.com, Palik's handbook and the SOPRA database as theirs.
// Fitted to colours under D65.

#include "pbrt/metals.h"

namespace duet::pbrt {

namespace {

constexpr Metal kMetals[] = {
    {"Ag", {0.12933, 0.12534, 0.15132}, {4.1107, 3.3513, 2.4129}},
    {"Al", {1.4275, 0.92947, 0.59155}, {7.7361, 6.6057, 5.3648}},
    {"Au", {0.00010003, 0.40634, 1.5726}, {19.999, 2.347, 1.7199}},
    {"Cu", {0.16811, 0.97644, 1.2114}, {3.6403, 2.6211, 2.3663}},
    {"MgO", {1.7337, 1.7409, 1.7535}, {0.0039128, 0.0036139, 0.0035847}},
    {"TiO2", {2.86, 2.9575, 3.1856}, {0.016708, 0.0019568, 0.013684}},
};

}  // namespace

std::span<const Metal> measured_metals() {
  return kMetals;
}

}  // namespace duet::pbrt
