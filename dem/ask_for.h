// Memory brought near before it is used.
#pragma once

#include <cstddef>

namespace interstice::dem {

inline constexpr std::size_t kCacheLine = 64;

// Always inline: gcc 12 takes a function that does nothing but ask for one without effect, and leaves calls
// of it out.

/// Asks for the cache lines of [begin, end) to come to the second cache. (To be read, also where they are
/// written later: what asks to write may bring them to the first cache, which holds too little.)
template <int locality = 2>
[[gnu::always_inline]] inline void ask_for(const char* begin, const char* end) {
  for (const char* line = begin; line < end; line += kCacheLine) __builtin_prefetch(line, 0, locality);
}
/// The same of n objects.
template <class T>
[[gnu::always_inline]] inline void ask_for(const T* object, std::size_t n = 1) {
  ask_for(reinterpret_cast<const char*>(object), reinterpret_cast<const char*>(object + n));
}

/// Asks for n objects that are read once and soon: to the first cache, and to leave without pushing others
/// out.
template <class T>
[[gnu::always_inline]] inline void ask_for_once(const T* object, std::size_t n) {
  ask_for<0>(reinterpret_cast<const char*>(object), reinterpret_cast<const char*>(object + n));
}

}  // namespace interstice::dem
