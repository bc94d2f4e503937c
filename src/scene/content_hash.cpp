#include "scene/content_hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>

#include "base/system/files.h"
#include "math/hash.h"
#include "scene/description.h"

namespace duet {

namespace {

/// Two hashes of the same words, which are mixed in different ways.
class Words {
 public:
  void add(uint64_t word) {
    hash_.high = hash_combine(hash_.high, word);
    hash_.low = mix64(std::rotl(hash_.low, 23) ^ (word * 0x9e3779b97f4a7c15ull)) + word;
  }
  void add_bytes(const char* bytes, size_t count) {
    for (; count > 0;
         bytes += std::min(count, sizeof(uint64_t)), count -= std::min(count, sizeof(uint64_t))) {
      uint64_t word = 0;
      std::memcpy(&word, bytes, std::min(count, sizeof word));
      add(word);
    }
  }
  const ContentHash& hash() const { return hash_; }

 private:
  ContentHash hash_{0x243f6a8885a308d3ull, 0x13198a2e03707344ull};
};

/// Hashes what descriptions are made of. What a description refers to by its number is hashed once,
/// by its content.
class Hasher {
 public:
  explicit Hasher(const SceneDescription& scene) : scene_(scene) {}

  ContentHash scene() {
    add(scene_.shapes), add(scene_.lights), add(scene_.sensors), add(scene_.integrator);
    return words_.hash();
  }

 private:
  // Numbers and texts. The two zeros are one number.
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) {
    if constexpr (std::is_floating_point_v<T>)
      words_.add(std::bit_cast<uint64_t>(double(value) + 0.0));
    else
      words_.add(uint64_t(value));
  }
  template <class T>
  requires std::is_enum_v<T>
  void add(T value) { words_.add(uint64_t(value)); }
  void add(const std::string& text) {
    words_.add(text.size());
    words_.add_bytes(text.data(), text.size());
  }
  void add(Choice choice) { words_.add(choice.index); }
  void add(const SourceLocation&) {}
  void add(const Label&) {}
  void add(const MeshSource&) {}  // where a mesh came from

  // Things of the standard library.
  template <class T>
  void add(const std::vector<T>& list) {
    words_.add(list.size());
    for (const T& x : list) add(x);
  }
  template <class T, size_t N>
  void add(const std::array<T, N>& list) {
    for (const T& x : list) add(x);
  }
  template <class A, class B>
  void add(const std::pair<A, B>& pair) {
    add(pair.first), add(pair.second);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    words_.add(value.has_value());
    if (value) add(*value);
  }
  template <class T>
  void add(const Boxed<T>& value) {
    words_.add(value.has_value());
    if (value) add(*value);
  }
  template <class... T>
  void add(const std::variant<T...>& value) {
    words_.add(value.index());
    std::visit([&](const auto& v) { add(v); }, value);
  }
  template <class T>
  void add(const std::shared_ptr<const T>& data) {
    words_.add(data != nullptr);
    if (data) add_once(data.get(), [&](Hasher& h) { h.add(*data); });
  }

  // Things of geometry and images.
  void add(const Spectrum& s) { add(s.r), add(s.g), add(s.b); }
  void add(const Point3f& p) { add(p.x), add(p.y), add(p.z); }
  void add(const Normal3f& n) { add(n.x), add(n.y), add(n.z); }
  void add(const Point2f& p) { add(p.x), add(p.y); }
  void add(const Matrix4& m) {
    for (int i = 0; i < 4; ++i) add(m[i]);
  }
  void add(const UvTransform& t) { add(t.m); }
  void add(const Motion& m) {
    add(m.keyframes().size());
    for (const Keyframe& k : m.keyframes()) add(k.time), add(k.pose);
  }
  void add(const FilterDescription& f) {
    add(f.kind), add(f.radius), add(f.stddev), add(f.b), add(f.c), add(f.lobes);
    add(f.reach_x), add(f.reach_y);
  }
  void add(const MeshAttribute& a) { add(a.name), add(a.channels), add(a.per_face), add(a.data); }
  void add(const TriangleMesh& m) {
    add(m.positions), add(m.normals), add(m.uvs), add(m.triangles), add(m.attributes);
    add(m.computed_normals);
    add(m.bump_tangents);
  }
  void add(const LensSurface& s) { add(s.radius), add(s.thickness), add(s.ior), add(s.aperture); }
  void add(const SampleLimit& l) { add(l.sensor), add(l.most); }
  void add(const TubePoint& p) { add(p.position), add(p.radius); }
  void add(const CurveSet& c) {
    add(c.kind), add(c.profile), add(c.points), add(c.segments), add(c.outside_only);
  }
  void add(const SdfGrid& g) { add(g.size), add(g.values), add(g.cells), add(g.smooth_normals); }
  void add(const VolumeGrid& g) {
    add(g.size), add(g.channels), add(g.lower), add(g.upper), add(g.values);
  }
  void add(const MeasuredTable::Grid& g) { add(g.size), add(g.values); }
  void add(const MeasuredTable& t) {
    add(t.phi), add(t.theta), add(t.ndf), add(t.sigma), add(t.vndf), add(t.luminance), add(t.rgb);
    add(t.has_jacobian);
  }

  // Descriptions, by their fields.
  template <HasFields T>
  void add(const T& description) {
    for_each_field(description, [&](const FieldFacts& f, const auto& value) { field(f, value); });
  }
  template <class T>
  void field(const FieldFacts& facts, const T& value) {
    if constexpr (std::is_same_v<T, std::string>)
      if (facts.names_data) return add_file(value);
    if (facts.compared && facts.given) add(value);
  }
  template <class Operations>
  void add(const Model<Operations>& model) {
    add(model.name());
    for_each_field(model, [&](const FieldFacts& f, const auto& value) { field(f, value); });
  }
  /// `group` is a number, too.
  void add(const InstanceShape& i) { add_once(&scene_.groups[i.group]); }

  // What is referred to by its number.
  void add(TextureId id) { add_once(&scene_.textures[size_t(id)]); }
  void add(MaterialId id) { add_once(&scene_.materials[size_t(id)]); }
  void add(VolumeId id) { add_once(&scene_.volumes[size_t(id)]); }
  void add(PhaseId id) { add_once(&scene_.phases[size_t(id)]); }
  void add(MediumId id) { add_once(&scene_.media[size_t(id)]); }

  template <class T>
  void add_once(const T* thing) {
    add_once(thing, [&](Hasher& h) { h.add(*thing); });
  }
  template <class Add>
  void add_once(const void* thing, const Add& add_thing) {
    const auto known = known_.find(thing);
    if (known != known_.end()) return add(known->second);
    const Words outer = std::exchange(words_, {});
    add_thing(*this);
    const ContentHash hash = words_.hash();
    words_ = outer;
    known_[thing] = hash;
    add(hash);
  }
  void add(const ContentHash& hash) { words_.add(hash.high), words_.add(hash.low); }
  void add_file(const std::string& path);

  const SceneDescription& scene_;
  Words words_;
  std::map<const void*, ContentHash> known_;
};

void Hasher::add_file(const std::string& path) {
  std::error_code ignored;
  // A pipe would wait forever.
  const bool is_file = std::filesystem::is_regular_file(path, ignored);
  const FileStream file = is_file ? open_for_reading(path) : nullptr;
  if (!file) return add(path);
  std::vector<char> block(1 << 20);
  size_t size = 0;
  while (const size_t n = std::fread(block.data(), 1, block.size(), file.get())) {
    words_.add_bytes(block.data(), n);
    size += n;
  }
  words_.add(size);
}

}  // namespace

std::string ContentHash::text() const {
  return fmt::format("{:016x}{:016x}", high, low);
}

ContentHash content_hash(const SceneDescription& scene) {
  return Hasher(scene).scene();
}

}  // namespace duet
