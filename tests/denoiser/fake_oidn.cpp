// A library with the functions of Open Image Denoise 2 that Duet calls. It denoises nothing: its
// output is colour + 10 albedo + 100 normal, so that tests see what it was given, and where.
// DUET_FAKE_OIDN=device|filter makes it fail.
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

namespace {

struct Pixels {
  float* data = nullptr;
  size_t count = 0;
};

struct Device {
  const char* error = nullptr;
  int threads = 0;
  bool has_affinity = true, is_committed = false;
};

struct Filter {
  Device* device;
  std::map<std::string, Pixels> images;
  std::map<std::string, bool> flags;
  bool is_committed = false;
};

bool fails(const char* what) {
  const char* asked = std::getenv("DUET_FAKE_OIDN");
  return asked && std::strcmp(asked, what) == 0;
}

}  // namespace

extern "C" {

Device* oidnNewDevice(int type) {
  return type == 1 ? new Device : nullptr;
}

void oidnSetDeviceInt(Device* device, const char* name, int value) {
  if (std::strcmp(name, "numThreads") == 0) device->threads = value;
}

void oidnSetDeviceBool(Device* device, const char* name, bool value) {
  if (std::strcmp(name, "setAffinity") == 0) device->has_affinity = value;
}

int oidnGetDeviceInt(Device*, const char* name) {
  return std::strcmp(name, "version") == 0 ? 29907 : 0;
}

void oidnCommitDevice(Device* device) {
  if (fails("device")) device->error = "no processor";
  if (device->threads < 1 || device->has_affinity) device->error = "wrong settings";
  device->is_committed = true;
}

int oidnGetDeviceError(Device* device, const char** message) {
  if (!device || !device->error) return 0;
  *message = device->error;
  device->error = nullptr;
  return 1;
}

void oidnReleaseDevice(Device* device) {
  delete device;
}

Filter* oidnNewFilter(Device* device, const char* type) {
  if (!device->is_committed || std::strcmp(type, "RT") != 0) device->error = "no such filter";
  return new Filter{device, {}, {}};
}

void oidnSetSharedFilterImage(Filter* filter, const char* name, void* pixels, int format,
                              size_t width, size_t height, size_t offset, size_t pixel_stride,
                              size_t row_stride) {
  if (format != 3 || offset + pixel_stride + row_stride != 0)
    filter->device->error = "wrong format";
  filter->images[name] = {static_cast<float*>(pixels), 3 * width * height};
}

void oidnSetFilterBool(Filter* filter, const char* name, bool value) {
  filter->flags[name] = value;
}

void oidnCommitFilter(Filter* filter) {
  filter->is_committed = true;
}

void oidnExecuteFilter(Filter* filter) {
  if (!filter->is_committed) filter->device->error = "not committed";
  const bool is_prefilter = !filter->images.contains("color");
  if (!is_prefilter && !(filter->flags["hdr"] && filter->flags["cleanAux"]))
    filter->device->error = "wrong flags";
  if (!is_prefilter && fails("filter")) filter->device->error = "out of memory";
  if (is_prefilter) return;
  const Pixels output = filter->images["output"];
  for (size_t i = 0; i < output.count; ++i)
    output.data[i] = filter->images["color"].data[i] + 10 * filter->images["albedo"].data[i] +
                     100 * filter->images["normal"].data[i];
}

void oidnReleaseFilter(Filter* filter) {
  delete filter;
}

}  // extern "C"
