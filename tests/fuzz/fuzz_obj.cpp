// Feeds arbitrary bytes to the OBJ reader; the first byte chooses the options.
#include "fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return duet::test::fuzz_mesh(data, size,
                               [](duet::ByteReader& in, const duet::MeshOptions& options) {
                                 for (const duet::ObjPart& part :
                                      duet::parse_obj(in, options, options.shape_index == 1).parts)
                                   duet::test::check_mesh(part.mesh);
                               });
}
