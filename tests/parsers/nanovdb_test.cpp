#include "volume/nanovdb_file.h"

#include <doctest/doctest.h>
#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/diagnostics.h"
#include "mitsuba/mitsuba.h"
#include "support/files.h"
#include "volume/volume_file.h"

using namespace duet;

namespace {

/// What the voxels of the test's grids are: a ball, larger than a node, and a speck far from it.
float voxel(int x, int y, int z) {
  if (x == 60 && y == -3 && z == 4) return 2;
  const float r = std::sqrt(float(x * x + y * y + z * z));
  return r < 11 ? 1 - r / 16 : 0;
}

template <class Build>
nanovdb::GridHandle<> make_grid(const std::string& name) {
  nanovdb::GridBuilder<float, Build> builder(0.0f, nanovdb::GridClass::FogVolume);
  auto values = builder.getAccessor();
  for (int x = -12; x <= 60; ++x)
    for (int y = -12; y <= 12; ++y)
      for (int z = -12; z <= 12; ++z)
        if (const float v = voxel(x, y, z); v > 0) values.setValue({x, y, z}, v);
  return builder.getHandle(0.5, nanovdb::Vec3d(1, 2, 3), name);
}

template <class Build = float>
std::string file_of(nanovdb::io::Codec codec = nanovdb::io::Codec::NONE) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path("a.nvdb");
  std::vector<nanovdb::GridHandle<>> grids;
  grids.push_back(make_grid<float>("other"));
  grids.push_back(make_grid<Build>("density"));
  nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(path, grids, codec);
  return test::read_file(path);
}

NanoVdbGrid parse(const std::string& file, const std::string& name = "density") {
  ByteReader in("a.nvdb", {reinterpret_cast<const uint8_t*>(file.data()), file.size()});
  return parse_nanovdb(in, name);
}

void check_grid(const NanoVdbGrid& g, double tolerance) {
  REQUIRE(g.grid.size == std::array{72, 22, 22});
  double worst = 0;
  for (int z = 0; z < 22; ++z)
    for (int y = 0; y < 22; ++y)
      for (int x = 0; x < 72; ++x) {
        const size_t i = (size_t(z) * 22 + size_t(y)) * 72 + size_t(x);
        worst = std::max(
            worst, std::abs(double(g.grid.values[i]) - double(voxel(x - 10, y - 10, z - 10))));
      }
  CHECK(worst <= tolerance);
  // The corners of the unit cube are the outermost nodes.
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(g.to_world[axis][3] == doctest::Approx(0.5 * -10 + axis + 1));
    CHECK(g.to_world[axis][axis] == doctest::Approx(0.5 * (axis == 0 ? 71 : 21)));
    CHECK(g.to_world[axis][(axis + 1) % 3] == 0);
  }
}

std::string message_of(const std::string& file, const std::string& name = "density") {
  try {
    parse(file, name);
  } catch (const ReadError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("grids of NanoVDB files are read, with any type of floats") {
  check_grid(parse(file_of()), 0);
  check_grid(parse(file_of(nanovdb::io::Codec::ZIP)), 0);
  // Within a leaf, codes are equal steps from the least to the greatest value.
  check_grid(parse(file_of<nanovdb::Fp16>()), 2e-5);
  check_grid(parse(file_of<nanovdb::Fp8>()), 5e-3);
  check_grid(parse(file_of<nanovdb::Fp4>()), 0.08);
  check_grid(parse(file_of<nanovdb::FpN>()), 0.08);
}

TEST_CASE("NanoVDB files that cannot be read are told why") {
  const std::string file = file_of();
  CHECK(message_of(file, "temperature") ==
        "a.nvdb: has no grid \"temperature\"; it has \"other\", \"density\"");
  CHECK(message_of("VDB") == "a.nvdb: the file ends in the middle of its header");
  CHECK(message_of("not a file of volumes") == "a.nvdb: is not a NanoVDB file");
  std::string other = file;
  other[11] = char(other[11] + 1);  // the upper bits of the version
  CHECK(message_of(other).find("only 32 is known") != std::string::npos);
  std::string empty = file;
  std::fill_n(empty.begin() + 16, 8, '\0');  // the bytes of the first grid
  CHECK(message_of(empty, "other") == "a.nvdb: has a grid of no bytes");
}

TEST_CASE("damaged NanoVDB files never lead astray") {
  const std::string file = file_of(), packed = file_of(nanovdb::io::Codec::ZIP);
  for (size_t length = 0; length < file.size(); length += 1 + length / 7)
    CHECK(!message_of(file.substr(0, length)).empty());
  for (size_t length = 0; length < packed.size(); length += 1 + length / 9)
    CHECK(!message_of(packed.substr(0, length)).empty());
  // What is damaged beyond recognition is refused; what is not has values that are finite.
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    std::string damaged = file;
    // Half of the damage is where sizes and offsets are.
    const size_t span = i % 2 ? damaged.size() : 2048;
    const size_t start = i % 4 == 0 ? damaged.size() / 2 : 0;
    for (int k = 0; k < 8; ++k)
      damaged[start + random() % std::min(span, damaged.size() - start)] = char(random());
    try {
      const std::vector<float> values = parse(damaged).grid.values;
      CHECK(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }));
    } catch (const ReadError&) {
      ++refused;
    }
  }
  CHECK(refused > 10);
}

TEST_CASE("NanoVDB files are grids of Mitsuba's media") {
  const test::TemporaryDirectory directory;
  directory.write("a.nvdb", file_of());
  const auto read = [&](const std::string& version, const std::string& more) {
    const std::string file = directory.write(
        "scene.xml", "<scene version='" + version +
                         "'><sensor type='perspective'/><shape type='cube'><medium name='interior' "
                         "type='heterogeneous'><volume name='" +
                         (version[0] == '0' ? "density" : "sigma_t") +
                         "' type='gridvolume'><string name='filename' value='a.nvdb'/>" + more +
                         "</volume><volume name='albedo' type='constvolume'><float name='value' "
                         "value='.5'/></volume></medium></shape></scene>");
    Diagnostics diagnostics;
    auto scene = read_mitsuba(file, {}, diagnostics);
    REQUIRE(scene);
    REQUIRE(scene->description.volumes.size() == 1);
    return scene->description.volumes[0];
  };
  // Where the file says, if the scene asks for that, as for .vol files.
  const NanoVdbGrid expected = parse(file_of());
  for (const VolumeDescription& v :
       {read("0.6.0", ""), read("3.0.0", "<boolean name='use_grid_bbox' value='true'/>")}) {
    CHECK(v.grid->values == expected.grid.values);
    CHECK(v.nodes == VolumeNodes::on_faces);
    CHECK_FALSE(v.is_float32);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        CHECK(v.to_world[i][j] == doctest::Approx(expected.to_world[i][j]));
  }
  CHECK(read("3.0.0", "").to_world == Matrix4{});
  CHECK(read("3.0.0", "").nodes == VolumeNodes::on_faces);
}

TEST_CASE("NanoVDB files that lie askew are no grids of Mitsuba's") {
  const test::TemporaryDirectory directory;
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  builder.getAccessor().setValue({0, 0, 0}, 1);
  nanovdb::Map turned;
  const double matrix[4][4] = {{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  turned.set(matrix, matrix, 1.0);
  std::vector<nanovdb::GridHandle<>> grids;
  grids.push_back(builder.getHandle(turned, "density"));
  nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(directory.path("b.NVDB"), grids,
                                                            nanovdb::io::Codec::NONE);
  CHECK_THROWS_WITH_AS(read_volume(directory.path("b.NVDB")),
                       doctest::Contains("the grid does not lie along the axes"), ReadError);
}
