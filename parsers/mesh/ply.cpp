// PLY (Stanford triangle format), ascii and binary.
#include <algorithm>
#include <limits>

#include "math/spectrum.h"
#include "mesh/formats.h"
#include "mesh/ply_attributes.h"
#include "mesh/ply_values.h"

namespace duet {

namespace {

/// The first of the given pairs or triples of names that the element has, as indices; or nothing.
std::vector<int> find_all(const PlyElement& element,
                          std::initializer_list<std::vector<std::string>> choices) {
  for (const std::vector<std::string>& names : choices) {
    std::vector<int> found;
    for (const std::string& name : names) found.push_back(element.find(name));
    if (*std::min_element(found.begin(), found.end()) >= 0) return found;
  }
  return {};
}

/// What becomes of a property's number in an attribute; see MeshDialect.
class Decoding {
 public:
  Decoding(const PlyAttribute& attribute, PlyType type, const MeshOptions& options) {
    if (options.dialect == MeshDialect::mitsuba0) {
      if (!attribute.is_color) return;
      if (type == PlyType::uint8) scale_ = 1.0 / 255;
      decode_ = options.srgb_colors;
    } else if (const double greatest = greatest_value(type); greatest > 0) {
      scale_ = 1 / greatest;
      decode_ = true;
    }
  }
  float operator()(double x) const {
    const float scaled = float(x * scale_);
    return decode_ ? srgb_to_linear(scaled) : scaled;
  }

 private:
  static double greatest_value(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return std::numeric_limits<int8_t>::max();
      case PlyType::int16:
        return std::numeric_limits<int16_t>::max();
      case PlyType::uint16:
        return std::numeric_limits<uint16_t>::max();
      case PlyType::int32:
        return std::numeric_limits<int32_t>::max();
      case PlyType::uint32:
        return std::numeric_limits<uint32_t>::max();
      default:
        return 0;
    }
  }
  double scale_ = 1;
  bool decode_ = false;
};

/// Picks the attributes out of rows of numbers.
class AttributeReader {
 public:
  AttributeReader(const ByteReader& in, const PlyElement& element, const char* prefix,
                  const std::vector<int>& used, const MeshOptions& options, TriangleMesh& mesh)
      : mesh_(mesh) {
    for (const PlyAttribute& a : group_attributes(element, prefix, used, options.dialect)) {
      if (mesh.find_attribute(a.name)) in.fail("there are two attributes \"{}\"", a.name);
      MeshAttribute& attribute = mesh.attributes.emplace_back();
      attribute.name = a.name;
      attribute.channels = int(a.properties.size());
      attribute.per_face = element.name == "face";
      attribute.data.reserve(element.count * a.properties.size());
      for (int p : a.properties)
        channels_.push_back({mesh.attributes.size() - 1, size_t(p),
                             Decoding(a, element.properties[size_t(p)].type, options)});
    }
  }
  void add(const std::vector<double>& row) {
    for (const Channel& c : channels_)
      mesh_.attributes[c.attribute].data.push_back(c.decoding(row[c.property]));
  }

 private:
  struct Channel {
    size_t attribute, property;
    Decoding decoding;
  };
  TriangleMesh& mesh_;
  std::vector<Channel> channels_;
};

void read_vertices(ByteReader& in, PlyValues& values, const PlyElement& element,
                   const MeshOptions& options, TriangleMesh& mesh) {
  const std::vector<int> xyz = find_all(element, {{"x", "y", "z"}});
  if (xyz.empty()) in.fail("the vertices have no x, y and z");
  if (element.count > std::numeric_limits<uint32_t>::max()) in.fail("there are too many vertices");
  const std::vector<int> normal = find_all(element, {{"nx", "ny", "nz"}});
  const std::vector<int> uv =
      find_all(element, {{"u", "v"}, {"texture_u", "texture_v"}, {"s", "t"}});
  std::vector<int> used = xyz;
  used.insert(used.end(), normal.begin(), normal.end());
  used.insert(used.end(), uv.begin(), uv.end());
  AttributeReader attributes(in, element, "vertex_", used, options, mesh);

  const bool keep_normals = !normal.empty() && !options.face_normals && !options.max_smooth_angle;
  mesh.positions.reserve(element.count);
  if (keep_normals) mesh.normals.reserve(element.count);
  if (!uv.empty()) mesh.uvs.reserve(element.count);
  std::vector<double> row(element.properties.size());
  const auto number = [&](int property) { return float(row[size_t(property)]); };
  for (uint64_t i = 0; i < element.count; ++i) {
    for (size_t p = 0; p < row.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.is_list)
        values.skip(property);
      else
        row[p] = values.next(property.type, "the vertices");
    }
    mesh.positions.push_back({number(xyz[0]), number(xyz[1]), number(xyz[2])});
    if (keep_normals)
      mesh.normals.push_back({number(normal[0]), number(normal[1]), number(normal[2])});
    if (!uv.empty()) mesh.uvs.push_back({number(uv[0]), number(uv[1])});
    attributes.add(row);
  }
}

void read_faces(ByteReader& in, PlyValues& values, const PlyElement& element,
                const MeshOptions& options, TriangleMesh& mesh) {
  int indices = -1;
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& p = element.properties[i];
    if (p.is_list && (p.name == "vertex_index" || p.name == "vertex_indices")) indices = int(i);
  }
  if (indices < 0) in.fail("the faces have no list \"vertex_indices\" or \"vertex_index\"");
  AttributeReader attributes(in, element, "face_", {}, options, mesh);

  mesh.triangles.reserve(element.count);
  std::vector<double> row(element.properties.size());
  for (uint64_t i = 0; i < element.count; ++i) {
    const size_t first_triangle = mesh.triangles.size();
    for (size_t p = 0; p < row.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (!property.is_list) {
        row[p] = values.next(property.type, "the faces");
      } else if (int(p) != indices) {
        values.skip(property);
      } else {
        // A polygon becomes a fan around its first vertex.
        const uint64_t corners = values.next_count(property.count_type, "the corners of a face");
        if (corners < 3) in.fail("face {} has {} corners", i, corners);
        const bool is_quad = options.quads && corners == 4;
        if (is_quad) options.quads->emplace_back();
        uint32_t first = 0, last = 0;
        for (uint64_t c = 0; c < corners; ++c) {
          const uint64_t index = values.next_count(property.type, "the index of a vertex");
          const uint32_t v =
              uint32_t(std::min<uint64_t>(index, std::numeric_limits<uint32_t>::max()));
          if (is_quad) {
            options.quads->back()[size_t(c)] = v;
            continue;
          }
          if (c == 0) first = v;
          if (c >= 2) mesh.triangles.push_back({first, last, v});
          last = v;
        }
      }
    }
    for (size_t t = first_triangle; t < mesh.triangles.size(); ++t) attributes.add(row);
  }
}

}  // namespace

TriangleMesh parse_ply(ByteReader& in, const MeshOptions& options) {
  const PlyHeader header = read_ply_header(in);
  if (header.format != PlyFormat::ascii) in.end_text();
  PlyValues values(in, header.format);
  TriangleMesh mesh;
  bool has_vertices = false, has_faces = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      if (has_vertices) in.fail("there are two elements \"vertex\"");
      has_vertices = true;
      read_vertices(in, values, element, options, mesh);
    } else if (element.name == "face") {
      if (has_faces) in.fail("there are two elements \"face\"");
      has_faces = true;
      read_faces(in, values, element, options, mesh);
    } else if (element.name == "tristrips" && element.count > 0) {
      in.fail("triangle strips are not supported; write the mesh with an element \"face\"");
    } else if (!element.properties.empty()) {
      for (uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& p : element.properties) values.skip(p);
    }
  }
  if (!has_vertices) in.fail("there is no element \"vertex\"");
  if (!has_faces) in.fail("there is no element \"face\"; is it a cloud of points?");
  const bool rest =
      header.format == PlyFormat::ascii ? !in.next_word().empty() : in.remaining() > 0;
  if (rest) in.fail("there is more in the file than its header announces");
  in.end_text();
  finish_mesh(in, options, mesh);
  return mesh;
}

}  // namespace duet
