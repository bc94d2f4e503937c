#include "image/exr_sizes.h"

#include <ImathBox.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVersion.h>
#include <OpenEXR/ImfXdr.h>
#include <fmt/format.h>

#include <stdexcept>

#include "image/image_limits.h"

namespace duet {

namespace {

/// The greatest width and height of a tile.
constexpr uint32_t kGreatestTileSize = 1 << 13;

void check_header(const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  const int64_t width = int64_t(window.max.x) - window.min.x + 1,
                height = int64_t(window.max.y) - window.min.y + 1;
  if (width <= 0 || height <= 0 || width > kGreatestImageSize || height > kGreatestImageSize)
    throw std::runtime_error(fmt::format("an image of {} x {} cannot be read", width, height));
  if (!header.hasTileDescription()) return;
  const Imf::TileDescription& tiles = header.tileDescription();
  if (tiles.xSize > kGreatestTileSize || tiles.ySize > kGreatestTileSize)
    throw std::runtime_error(
        fmt::format("tiles of {} x {} cannot be read", tiles.xSize, tiles.ySize));
}

}  // namespace

void check_sizes(Imf::IStream& stream) {
  int magic = 0, version = 0;
  Imf::Xdr::read<Imf::StreamIO>(stream, magic);
  Imf::Xdr::read<Imf::StreamIO>(stream, version);
  if (magic != Imf::MAGIC) throw std::runtime_error("is not an OpenEXR file");
  do {
    Imf::Header header;
    header.readFrom(stream, version);
    // An empty header ends the list of those of several parts.
    if (header.readsNothing()) break;
    check_header(header);
  } while (Imf::isMultiPart(version));
  stream.seekg(0);
}

}  // namespace duet
