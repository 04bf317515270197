// Memory brought near before it is used.
#pragma once

#include <cstddef>

namespace interstice::dem {

inline constexpr std::size_t kCacheLine = 64;

/// Asks for the cache lines of [begin, end) to come to the second cache, to be read or `written`, too.
template <bool written = true>
inline void ask_for(const char* begin, const char* end) {
  for (const char* line = begin; line < end; line += kCacheLine) __builtin_prefetch(line, written, 2);
}
/// The same of one object.
template <bool written = true, class T>
inline void ask_for(const T* object) {
  const auto* const begin = reinterpret_cast<const char*>(object);
  ask_for<written>(begin, begin + sizeof(T));
}

}  // namespace interstice::dem
