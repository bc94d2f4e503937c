// The environment variables that the program looks at, for `duet --help` and the manual page.
#pragma once

#include <string_view>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "evaluate/report/read_scene.h"
#include "image/codecs.h"
#include "image/denoiser_library.h"

namespace duet {

struct EnvironmentVariable {
  std::string_view name, what;
};
inline constexpr EnvironmentVariable kEnvironment[] = {
    {kThreadsVariable, "number of threads where no option says it"},
    {kPathVariable, "further folders to look for files of scenes, between colons"},
    {kMemoryLimitVariable, "bytes of memory that a render may take"},
    {kImageModuleVariable, "duet_oiio.so, for images that are neither EXR nor JPEG nor plain PNG"},
    {kDenoiserVariable, "libOpenImageDenoise.so, for --denoise"}};

}  // namespace duet
