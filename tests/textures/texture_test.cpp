// Textures against what Mitsuba looks up.
#include "textures/texture.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "base/diagnostics.h"
#include "support/tables.h"
#include "textures/bitmap.h"
#include "textures/checkerboard.h"
#include "textures/mesh_attribute.h"

using namespace duet;

namespace {

UvTransform to_uv_transform(const test::Json& rows) {
  UvTransform t;
  for (size_t i = 0; i < 2; ++i)
    for (size_t j = 0; j < 3; ++j) t.m[i][j] = rows[i][j];
  return t;
}

std::shared_ptr<const BitmapPixels> to_pixels(const test::Json& t) {
  const int w = t["width"], h = t["height"], n = t["channels"];
  if (!t["bytes"])
    return std::make_shared<BitmapPixels>(w, h, n, t["pixels"].get<std::vector<float>>());
  // By way of a file, as the scene builder makes them.
  ImageFile file;
  file.image.width = w;
  file.image.height = h;
  file.image.channels =
      n == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  file.bytes = t["pixels"].get<std::vector<uint8_t>>();
  file.display_encoded = true;
  BitmapDecoding decoding;
  decoding.raw = t["raw"];
  return std::make_shared<BitmapPixels>(BitmapPixels::from_file(file, decoding));
}

std::unique_ptr<Texture> to_texture(const test::Json& t) {
  const UvTransform to_uv = to_uv_transform(t["to_uv"]);
  if (t["kind"] == "checkerboard")
    return std::make_unique<Checkerboard>(ColorSlot{{0.1f, 0.4f, 0.7f}},
                                          ColorSlot{{0.9f, 0.2f, 0.3f}}, to_uv, true);
  const WrapMode wrap = t["wrap"] == "repeat"   ? WrapMode::repeat
                        : t["wrap"] == "mirror" ? WrapMode::mirror
                                                : WrapMode::clamp;
  const TextureFilter filter =
      t["filter"] == "nearest" ? TextureFilter::nearest : TextureFilter::bilinear;
  return std::make_unique<Bitmap>(to_pixels(t), filter, wrap, wrap, to_uv);
}

Surface at(float u, float v) {
  Surface s;
  s.uv = {u, v};
  return s;
}

void check_near(float a, float b, float tolerance) {
  CHECK(std::abs(a - b) <= tolerance * (1 + std::abs(b)));
}

}  // namespace

TEST_CASE("textures look up what Mitsuba looks up") {
  const test::Json table = test::read_table("textures");
  for (const test::Json& t : table["textures"]) {
    const auto texture = to_texture(t);
    test::Json shown = t;
    shown.erase("lookups");
    INFO(shown.dump());
    const Spectrum average = texture->average();
    // A constant colour asked for a number yields its mean, a bitmap its luminance.
    CHECK((t["kind"] == "bitmap" ? average.luminance() : average.mean()) ==
          doctest::Approx(t["mean"].get<float>()).epsilon(1e-5));
    for (const test::Json& row : t["lookups"]) {
      INFO(row.dump());
      const Surface s = at(row[0], row[1]);
      const Spectrum c = texture->color(s);
      // At texture coordinates of a few units, single precision leaves this much.
      for (int k = 0; k < 3; ++k) check_near(c[k], row[size_t(2 + k)], 2e-5f);
      check_near(texture->value(s), row[5], 2e-5f);
      const Point2f g = texture->gradient(s);
      check_near(g.x, row[6], 1e-4f);
      check_near(g.y, row[7], 1e-4f);
    }
  }
}

TEST_CASE("mesh attributes are interpolated as Mitsuba does") {
  const test::Json table = test::read_table("textures");
  TriangleMesh mesh = test::to_mesh(table["mesh"]);
  for (const test::Json& a : table["attributes"]) {
    MeshAttribute attribute;
    attribute.name = a["name"];
    attribute.channels = a["channels"];
    attribute.per_face = attribute.name.starts_with("face_");
    attribute.data = a["data"].get<std::vector<float>>();
    mesh.attributes.push_back(attribute);
  }
  Shape shape;
  shape.mesh = std::make_shared<TriangleMesh>(mesh);
  for (const test::Json& a : table["attributes"]) {
    MeshAttributeMap texture(a["name"], a["scale"]);
    REQUIRE(texture.add_shape(shape, true).empty());
    for (const test::Json& row : a["lookups"]) {
      INFO(a["name"].dump() << " " << row.dump());
      // The topmost triangle under the point.
      const float x = row[0], y = row[1];
      float top = -INFINITY;
      Surface s;
      s.shape = &shape;
      for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Point3f p0 = mesh.positions[mesh.triangles[i][0]];
        const Vector3f e1 = mesh.positions[mesh.triangles[i][1]] - p0,
                       e2 = mesh.positions[mesh.triangles[i][2]] - p0;
        const float det = e1.x * e2.y - e1.y * e2.x;
        const float b1 = ((x - p0.x) * e2.y - (y - p0.y) * e2.x) / det;
        const float b2 = (e1.x * (y - p0.y) - e1.y * (x - p0.x)) / det;
        const float z = p0.z + b1 * e1.z + b2 * e2.z;
        if (b1 < 0 || b2 < 0 || b1 + b2 > 1 || z < top) continue;
        top = z;
        s.primitive = i;
        s.barycentric = {b1, b2};
      }
      const Spectrum c = texture.color(s);
      for (int k = 0; k < 3; ++k) check_near(c[k], row[size_t(2 + k)], 1e-5f);
      if (a["channels"] == 1) check_near(texture.value(s), row[5], 1e-5f);
      // A step along u changes the value as the gradient says.
      const auto moved = [&](float du, float dv) {
        const auto& t = mesh.triangles[s.primitive];
        const Point2f p = mesh.uvs[t[1]] - mesh.uvs[t[0]], q = mesh.uvs[t[2]] - mesh.uvs[t[0]];
        const float det = p.x * q.y - p.y * q.x;
        Surface m = s;
        m.barycentric.x += (du * q.y - dv * q.x) / det;
        m.barycentric.y += (p.x * dv - p.y * du) / det;
        return texture.value(m) - texture.value(s);
      };
      const Point2f g = texture.gradient(s);
      check_near(g.x, moved(0.125f, 0) * 8, 1e-4f);
      check_near(g.y, moved(0, 0.125f) * 8, 1e-4f);
    }
  }
  MeshAttributeMap other("vertex_nothing", 1);
  CHECK(other.add_shape(shape, true) == "attribute \"vertex_nothing\"");
}

TEST_CASE("the channels of a file become a texture's") {
  ImageFile file;
  file.image = Image(2, 1, {"A", "B", "G", "R"});
  file.image.data = {0.5f, 1, 2, 3, 0.25f, 4, 5, 6};
  const auto texel = [&](BitmapDecoding d) { return BitmapPixels::from_file(file, d); };
  CHECK(texel({}).color(1, 0) == Spectrum(6, 5, 4));
  CHECK(texel({.channel = TextureChannel::green}).value(0, 0) == 2);
  CHECK(texel({.channel = TextureChannel::alpha}).value(1, 0) == 0.25f);
  CHECK(texel({.gamma = 2.0}).color(0, 0) == Spectrum(9, 4, 1));
  // Opacity has no transfer curve, and raw values neither.
  CHECK(texel({.gamma = 2.0, .channel = TextureChannel::alpha}).value(0, 0) == 0.5f);
  CHECK(texel({.raw = true, .gamma = 2.0}).color(0, 0) == Spectrum(3, 2, 1));
  // pbrt's numbers: the alpha of an image that is not opaque, else the mean of the colours.
  CHECK(texel({.gamma = 2.0, .channel = TextureChannel::number}).value(0, 0) == 0.5f);
  ImageFile opaque = file;
  opaque.image.data[0] = opaque.image.data[4] = 1;
  CHECK(BitmapPixels::from_file(opaque, {.gamma = 2.0, .channel = TextureChannel::number})
            .value(0, 0) == doctest::Approx(14.0 / 3));
  ImageFile bytes;
  bytes.image.width = bytes.image.height = 1;
  bytes.image.channels = {"R", "G", "B"};
  bytes.bytes = {0, 255, 255};
  const BitmapPixels mean = BitmapPixels::from_file(bytes, {.channel = TextureChannel::number});
  CHECK(mean.is_grey());
  CHECK(mean.value(0, 0) == doctest::Approx(2.0 / 3));
  file.display_encoded = true;
  CHECK(texel({}).color(0, 0).b == doctest::Approx(1));
  CHECK(texel({.gamma = 1.0}).color(0, 0).r == 3);
  file.image.channels = {"A", "B", "G", "Z"};
  CHECK_THROWS_AS(texel({}), ReadError);
  file.image = Image(1, 1, {"Z"});
  CHECK_THROWS_AS(texel({.channel = TextureChannel::alpha}), ReadError);
  CHECK(texel({}).is_grey());
}

TEST_CASE("0.x textures may end in black or white") {
  const auto pixels = std::make_shared<BitmapPixels>(2, 1, 1, std::vector<float>{0.25f, 0.5f});
  const auto value = [&](WrapMode wrap, float u, TextureFilter filter = TextureFilter::bilinear) {
    return Bitmap(pixels, filter, wrap, WrapMode::clamp, {}).value(at(u, 0.5f));
  };
  CHECK(value(WrapMode::zero, 0.25f) == 0.25f);
  CHECK(value(WrapMode::zero, 0.0f) == 0.125f);
  CHECK(value(WrapMode::zero, -3.0f) == 0);
  CHECK(value(WrapMode::one, 1.0f) == 0.75f);
  CHECK(value(WrapMode::one, 9.0f) == 1);
  CHECK(value(WrapMode::zero, 1.01f, TextureFilter::nearest) == 0);
  CHECK(value(WrapMode::zero, 0.99f, TextureFilter::nearest) == 0.5f);
  CHECK(value(WrapMode::one, -0.01f, TextureFilter::nearest) == 1);
}

TEST_CASE("no texture coordinate leads out of the image") {
  const auto pixels = std::make_shared<BitmapPixels>(3, 5, 1, std::vector<float>(15, 0.5f));
  for (const WrapMode wrap :
       {WrapMode::repeat, WrapMode::mirror, WrapMode::clamp, WrapMode::zero, WrapMode::one})
    for (const TextureFilter filter : {TextureFilter::nearest, TextureFilter::bilinear})
      for (const float u :
           {NAN, INFINITY, -INFINITY, 3e38f, -1e-9f, 1e-45f, 1e9f, 1.0f, 0x1.fffffep-1f}) {
        const Bitmap texture(pixels, filter, wrap, wrap, {});
        for (const Surface& s : {at(u, 0.5f), at(0.5f, u), at(u, u)}) {
          const float v = texture.value(s);
          CHECK((std::isnan(v) || (v >= 0 && v <= 1)));
          texture.gradient(s);
        }
      }
}

TEST_CASE("numbers that are not finite are taken out of images") {
  ImageFile file;
  file.image = Image(5, 1, {"Y"});
  file.image.data = {1, NAN, INFINITY, -INFINITY, 0};
  const BitmapPixels pixels = BitmapPixels::from_file(file, {});
  CHECK(pixels.replaced() == 3);
  const float expected[] = {1, 0, 65504, -65504, 0};
  for (int x = 0; x < 5; ++x) CHECK(pixels.value(x, 0) == expected[x]);
}

TEST_CASE("texels stay as small as they are in their file") {
  ImageFile file;
  file.image = Image(3, 2, {"R", "G", "B", "A"});
  for (size_t i = 0; i < file.image.data.size(); ++i) file.image.data[i] = 0.25f * float(i) - 1;
  const auto texels = [&](const BitmapDecoding& decoding) {
    return BitmapPixels::from_file(file, decoding);
  };
  const BitmapPixels halves = texels({});
  CHECK(halves.type() == TexelType::half);
  CHECK(texels({.channel = TextureChannel::green}).type() == TexelType::half);
  CHECK(texels({.gamma = 2.2}).type() == TexelType::single);
  // One number that a half does not hold.
  file.image.data[0] = 0.1f;
  const BitmapPixels floats = texels({});
  CHECK(floats.type() == TexelType::single);
  CHECK(floats.color(0, 0).r == 0.1f);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const size_t at = size_t(4 * (3 * y + x));
      CHECK(halves.color(x, y).b == file.image.data[at + 2]);
      CHECK(floats.color(x, y).g == file.image.data[at + 1]);
      CHECK(texels({.channel = TextureChannel::green}).value(x, y) == file.image.data[at + 1]);
    }
  file.bytes.assign(file.image.data.size(), 51);
  CHECK(texels({}).type() == TexelType::byte);
  CHECK(texels({.raw = true}).color(2, 1).g == 0.2f);
}
