// Whether this is compiled with the thread sanitizer.
#pragma once

namespace duet {

/// It does not see how the library of oneTBB makes threads wait for each other, and would find a
/// data race wherever a loop reads what was written before it. So loops start threads of their own
/// then, and Embree builds with one.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kThreadSanitizer = __has_feature(thread_sanitizer);
#else
inline constexpr bool kThreadSanitizer = false;
#endif

}  // namespace duet
