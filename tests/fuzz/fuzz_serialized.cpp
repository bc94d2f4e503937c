// Feeds arbitrary bytes to the reader of .serialized files; the first byte chooses the options.
// Every input is tried twice: as it is, and compressed, so that the fuzzer need not find out how
// zlib works.
#include "fuzz/fuzz_mesh.h"
#include "support/serialized.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto read = [](duet::ByteReader& in, const duet::MeshOptions& options) {
    duet::test::check_mesh(duet::parse_serialized(in, options));
  };
  duet::test::fuzz_mesh(data, size, read);
  if (size < 2) return 0;
  const std::string contents(reinterpret_cast<const char*>(data) + 2, size - 2);
  const std::string file = std::string(1, char(data[0])) +
                           duet::test::pack(uint16_t(0x041c), uint16_t(3 + data[1] % 2)) +
                           duet::test::deflate(contents);
  return duet::test::fuzz_mesh(reinterpret_cast<const uint8_t*>(file.data()), file.size(), read);
}
