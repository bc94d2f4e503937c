// Open Image Denoise's library, loaded while the program runs: nothing is linked with it.
#pragma once

#include <cstddef>

namespace duet {

struct OidnDeviceHandle;
struct OidnFilterHandle;

/// The part of its C interface, version 2, that is used; what each does is described in its
/// documentation (https://www.openimagedenoise.org/documentation.html).
struct OidnFunctions {
  OidnDeviceHandle* (*new_device)(int type);
  void (*set_device_int)(OidnDeviceHandle*, const char* name, int value);
  void (*set_device_bool)(OidnDeviceHandle*, const char* name, bool value);
  int (*get_device_int)(OidnDeviceHandle*, const char* name);
  void (*commit_device)(OidnDeviceHandle*);
  int (*get_device_error)(OidnDeviceHandle*, const char** message);
  void (*release_device)(OidnDeviceHandle*);
  OidnFilterHandle* (*new_filter)(OidnDeviceHandle*, const char* type);
  void (*set_filter_image)(OidnFilterHandle*, const char* name, void* pixels, int format,
                           size_t width, size_t height, size_t byte_offset,
                           size_t bytes_between_pixels, size_t bytes_between_rows);
  void (*set_filter_bool)(OidnFilterHandle*, const char* name, bool value);
  void (*commit_filter)(OidnFilterHandle*);
  void (*execute_filter)(OidnFilterHandle*);
  void (*release_filter)(OidnFilterHandle*);
};

/// The environment variable that says where the library is.
inline constexpr const char* kDenoiserVariable = "DUET_OIDN_LIBRARY";

/// Loads the library: the file that DUET_OIDN_LIBRARY names, else one in the directories for
/// modules (module_paths.h), else what the system's loader finds. Throws std::runtime_error with
/// what was tried if there is none, if it cannot be loaded, and if it is something else. It stays
/// loaded.
const OidnFunctions& load_denoiser_library();

}  // namespace duet
