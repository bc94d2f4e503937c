#include "measured/measured_file.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace duet {

namespace {

/// An array of the file that has not been read yet.
struct Field {
  uint8_t type;
  uint64_t offset;
  std::vector<uint64_t> shape;
};
constexpr uint8_t kUint8 = 1, kFloat32 = 10;

using Fields = std::map<std::string, Field>;

Fields read_header(ByteReader& in) {
  constexpr char kMagic[12] = "tensor_file";
  if (in.size() < sizeof kMagic + 6 ||
      std::memcmp(in.take(sizeof kMagic, "the header"), kMagic, sizeof kMagic) != 0)
    in.fail("is not a measured material (a tensor file)");
  const int major = in.take_value<uint8_t>("the header"),
            minor = in.take_value<uint8_t>("the header");
  if (major != 1) in.fail("is of version {}.{}; only 1.0 is known", major, minor);
  const uint32_t count = in.take_value<uint32_t>("the header");
  if (count > 100) in.fail("has {} fields, which are too many", count);
  Fields fields;
  for (uint32_t i = 0; i < count; ++i) {
    const uint16_t length = in.take_value<uint16_t>("the header");
    const uint8_t* text = in.take(length, "the header");
    const std::string name(reinterpret_cast<const char*>(text), length);
    const uint16_t dimensions = in.take_value<uint16_t>("the header");
    if (dimensions > 8) in.fail("has a field with {} dimensions", dimensions);
    Field f;
    f.type = in.take_value<uint8_t>("the header");
    f.offset = in.take_value<uint64_t>("the header");
    for (uint16_t d = 0; d < dimensions; ++d)
      f.shape.push_back(in.take_value<uint64_t>("the header"));
    fields[name] = std::move(f);
  }
  return fields;
}

const Field& find(ByteReader& in, const Fields& fields, const char* name, uint8_t type,
                  size_t dimensions) {
  const auto it = fields.find(name);
  if (it == fields.end()) in.fail("has no field \"{}\"", name);
  if (it->second.type != type || it->second.shape.size() != dimensions)
    in.fail("the field \"{}\" has another type or number of dimensions than it should", name);
  return it->second;
}

/// The numbers of a field; their number is known to be there.
std::vector<float> read_floats(ByteReader& in, const Field& f, const char* name, bool is_density) {
  uint64_t count = 1;
  for (const uint64_t n : f.shape) {
    if (n == 0 || n > in.size() / 4 || count > in.size() / 4 / n)
      in.fail("the field \"{}\" is larger than the file, or empty", name);
    count *= n;
  }
  if (f.offset > in.size() || (in.size() - f.offset) / 4 < count)
    in.fail("the file ends in the middle of the field \"{}\"", name);
  in.seek(f.offset);
  std::vector<float> values(count);
  for (float& v : values) {
    v = in.take_value<float>(name);
    if (!std::isfinite(v) || (is_density && v < 0))
      in.fail("the field \"{}\" has the value {:g}", name, v);
  }
  return values;
}

std::vector<float> read_angles(ByteReader& in, const Fields& fields, const char* name) {
  const std::vector<float> a = read_floats(in, find(in, fields, name, kFloat32, 1), name, false);
  for (size_t i = 1; i < a.size(); ++i)
    if (!(a[i] > a[i - 1])) in.fail("the angles \"{}\" do not increase", name);
  return a;
}

/// The last two dimensions of `shape` are the size of the grid, the others are `outer`.
MeasuredTable::Grid read_grid(ByteReader& in, const Fields& fields, const char* name,
                              const std::vector<size_t>& outer, bool is_density) {
  const Field& f = find(in, fields, name, kFloat32, outer.size() + 2);
  for (size_t i = 0; i < outer.size(); ++i)
    if (f.shape[i] != outer[i])
      in.fail("the field \"{}\" has {} entries where it should have {}", name, f.shape[i],
              outer[i]);
  MeasuredTable::Grid grid;
  constexpr uint64_t kMost = 1 << 15;
  for (size_t i = 0; i < 2; ++i) {
    const uint64_t n = f.shape[f.shape.size() - 1 - i];
    if (n < 2 || n > kMost) in.fail("the field \"{}\" has {} nodes along an axis", name, n);
    grid.size[i] = uint32_t(n);
  }
  grid.values = read_floats(in, f, name, is_density);
  return grid;
}

}  // namespace

MeasuredTable parse_measured(ByteReader& in) {
  in.end_text();
  const Fields fields = read_header(in);
  if (!fields.contains("rgb") && fields.contains("spectra"))
    in.fail("has spectra; a file in RGB (its name ends in _rgb.bsdf) is needed");
  MeasuredTable t;
  t.theta = read_angles(in, fields, "theta_i");
  t.phi = read_angles(in, fields, "phi_i");
  t.ndf = read_grid(in, fields, "ndf", {}, false);
  t.sigma = read_grid(in, fields, "sigma", {}, false);
  t.vndf = read_grid(in, fields, "vndf", {t.phi.size(), t.theta.size()}, true);
  t.luminance = read_grid(in, fields, "luminance", {t.phi.size(), t.theta.size()}, true);
  t.rgb = read_grid(in, fields, "rgb", {t.phi.size(), t.theta.size(), 3}, false);
  const Field& jacobian = find(in, fields, "jacobian", kUint8, 1);
  if (jacobian.shape[0] != 1 || jacobian.offset >= in.size())
    in.fail("the field \"jacobian\" is not one byte");
  in.seek(jacobian.offset);
  t.has_jacobian = in.take_value<uint8_t>("jacobian") != 0;
  return t;
}

MeasuredTable read_measured(const std::string& file) {
  return parse_file(file, parse_measured);
}

}  // namespace duet
