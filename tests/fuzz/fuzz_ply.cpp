// Feeds arbitrary bytes to the PLY reader; the first byte chooses the options.
#include "fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return duet::test::fuzz_mesh(data, size,
                               [](duet::ByteReader& in, const duet::MeshOptions& options) {
                                 duet::test::check_mesh(duet::parse_ply(in, options));
                               });
}
