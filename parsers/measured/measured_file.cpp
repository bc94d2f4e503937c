#include "measured/measured_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "values/color.h"

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

/// What each entry of a spectrum adds to its colour under D65.
std::vector<Spectrum> color_weights(const std::vector<float>& wavelengths) {
  std::vector<SpectrumSample> samples;
  for (const float w : wavelengths) samples.push_back({double(w), 1});
  // Colours of spectra are clamped to be positive: what a little less makes of white is not.
  constexpr double kLess = 0.125;
  const Spectrum white = spectrum_to_rgb(samples, ColorMeaning::unbounded);
  std::vector<Spectrum> weights;
  for (SpectrumSample& s : samples) {
    s.value = 1 - kLess;
    weights.push_back((white - spectrum_to_rgb(samples, ColorMeaning::unbounded)) *
                      float(1 / kLess));
    s.value = 1;
  }
  return weights;
}

/// The field "spectra" as colours.
MeasuredTable::Grid read_spectra(ByteReader& in, const Fields& fields, const MeasuredTable& t) {
  const std::vector<float> wavelengths = read_angles(in, fields, "wavelengths");
  constexpr size_t kMost = 10000;
  if (wavelengths.size() > kMost) in.fail("has {} wavelengths", wavelengths.size());
  const MeasuredTable::Grid spectra =
      read_grid(in, fields, "spectra", {t.phi.size(), t.theta.size(), wavelengths.size()}, false);
  const std::vector<Spectrum> weights = color_weights(wavelengths);
  MeasuredTable::Grid rgb;
  rgb.size = spectra.size;
  const size_t nodes = spectra.nodes(), directions = t.phi.size() * t.theta.size();
  rgb.values.resize(directions * 3 * nodes);
  std::vector<Spectrum> sum(nodes);
  for (size_t d = 0; d < directions; ++d) {
    std::fill(sum.begin(), sum.end(), Spectrum(0.0f));
    for (size_t w = 0; w < wavelengths.size(); ++w)
      for (size_t i = 0; i < nodes; ++i)
        sum[i] +=
            weights[w] * std::max(spectra.values[(d * wavelengths.size() + w) * nodes + i], 0.0f);
    for (int c = 0; c < 3; ++c)
      for (size_t i = 0; i < nodes; ++i)
        rgb.values[(d * 3 + size_t(c)) * nodes + i] = std::max(sum[i][c], 0.0f);
  }
  return rgb;
}

}  // namespace

MeasuredTable parse_measured(ByteReader& in) {
  in.end_text();
  const Fields fields = read_header(in);
  MeasuredTable t;
  t.theta = read_angles(in, fields, "theta_i");
  t.phi = read_angles(in, fields, "phi_i");
  t.ndf = read_grid(in, fields, "ndf", {}, false);
  t.sigma = read_grid(in, fields, "sigma", {}, false);
  t.vndf = read_grid(in, fields, "vndf", {t.phi.size(), t.theta.size()}, true);
  t.luminance = read_grid(in, fields, "luminance", {t.phi.size(), t.theta.size()}, true);
  t.rgb = !fields.contains("rgb") && fields.contains("spectra")
              ? read_spectra(in, fields, t)
              : read_grid(in, fields, "rgb", {t.phi.size(), t.theta.size(), 3}, false);
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
