// Reads NanoVDB files (.nvdb): sparse grids of numbers, as pbrt's clouds and smoke have them.
#pragma once

#include <optional>
#include <string>

#include "math/transform.h"
#include "media/volume_grid.h"
#include "mesh/byte_reader.h"

namespace duet {

/// A grid made dense, and where it lies.
struct NanoVdbGrid {
  /// One channel. From the first voxel of the box of active voxels to one beyond the last, which
  /// has the background's value: interpolation between nodes is then that of NanoVDB in the box
  /// that NanoVDB calls the grid's, from the first voxel to one beyond the last.
  VolumeGrid grid;
  /// Maps the unit cube, on whose faces the outermost nodes lie, to the space of the file.
  Matrix4 to_world;
};

/// The first grid of that name, of floats or quantised floats (types Float, Fp4, Fp8, Fp16, FpN),
/// uncompressed or by zlib, in files of version 32. Throws ReadError "file: message", also if the
/// file has no such grid or if its box has far more voxels than are stored.
/// Source: Museth, "NanoVDB: A GPU-friendly and portable VDB data structure for real-time rendering
/// and simulation", SIGGRAPH Talks 2021; the layout is that of Debian's libnanovdb-dev.
NanoVdbGrid read_nanovdb(const std::string& file, const std::string& name);
/// The same; nothing if the file has no such grid.
std::optional<NanoVdbGrid> find_nanovdb(const std::string& file, const std::string& name);
/// The same for an opened file.
NanoVdbGrid parse_nanovdb(ByteReader& in, const std::string& name);

}  // namespace duet
