// A number type of several lanes: the contact laws, written for a scalar, run on it unchanged, one contact a
// lane. Choices that differ from lane to lane are selects (contact/numeric.h). Lanes never mix, so a lane's
// bits do not depend on which lane it is or on what the others hold.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "dem/contact/numeric.h"

namespace interstice::dem::simd {

/// Bytes of the machine's own registers, for which this is compiled.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define INTERSTICE_AVX512 1
inline constexpr int kNativeBytes = 64;
#elif defined(__AVX__)
inline constexpr int kNativeBytes = 32;
#else
inline constexpr int kNativeBytes = 16;
#endif

template <class T, int N>
inline constexpr bool kFitsRegister = N* static_cast<int>(sizeof(T)) <= kNativeBytes;

template <class T>
using IntegerOf = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

/// While it lives, numbers below the smallest normal one count as zero: a spin that friction takes away goes
/// through them for thousands of steps, each a hundred times slower.
class FlushTinyNumbers {
 public:
#if defined(__SSE2__)
  FlushTinyNumbers() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~FlushTinyNumbers() { _mm_setcsr(before_); }
  FlushTinyNumbers(const FlushTinyNumbers&) = delete;
  FlushTinyNumbers& operator=(const FlushTinyNumbers&) = delete;

 private:
  unsigned before_;
#endif
};

// What a pack, a mask or rows consist of is `mutable` for the compiler's sake: gcc 12 keeps the parts of a
// constant of such a type in memory and copies them to and fro, because a constant cannot be taken apart.

/// A truth value a lane, in one register or in two halves.
template <class T, int N, bool = kFitsRegister<T, N>>
struct Mask;
/// N numbers, in one register or in two halves.
template <class T, int N, bool = kFitsRegister<T, N>>
struct Pack;

#ifdef INTERSTICE_AVX512
template <class T, int N>
struct Mask<T, N, true> {
  mutable std::uint32_t lanes;  // bit by lane

  std::uint32_t bits() const { return lanes; }
  static Mask from_bits(std::uint32_t b) { return {b & ((1u << N) - 1)}; }
  friend Mask operator&(Mask a, Mask b) { return {a.lanes & b.lanes}; }
  friend Mask operator|(Mask a, Mask b) { return {a.lanes | b.lanes}; }
  friend Mask operator!(Mask a) { return {a.lanes ^ ((1u << N) - 1)}; }
};
#else
template <class T, int N>
struct Mask<T, N, true> {
  typedef IntegerOf<T> Lanes __attribute__((vector_size(N * sizeof(T))));
  mutable Lanes lanes;  // all ones or zero

  std::uint32_t bits() const {
    std::uint32_t b = 0;
    for (int i = 0; i < N; ++i) b |= (lanes[i] != 0 ? 1u : 0u) << i;
    return b;
  }
  static Mask from_bits(std::uint32_t b) {
    Mask m;
    for (int i = 0; i < N; ++i) m.lanes[i] = -static_cast<IntegerOf<T>>(b >> i & 1u);
    return m;
  }
  friend Mask operator&(Mask a, Mask b) { return {a.lanes & b.lanes}; }
  friend Mask operator|(Mask a, Mask b) { return {a.lanes | b.lanes}; }
  friend Mask operator!(Mask a) { return {~a.lanes}; }
};
#endif

template <class T, int N>
struct Mask<T, N, false> {
  Mask<T, N / 2> lo, hi;

  std::uint32_t bits() const { return lo.bits() | hi.bits() << (N / 2); }
  static Mask from_bits(std::uint32_t b) {
    return {Mask<T, N / 2>::from_bits(b & ((1u << (N / 2)) - 1)), Mask<T, N / 2>::from_bits(b >> (N / 2))};
  }
  friend Mask operator&(const Mask& a, const Mask& b) { return {a.lo & b.lo, a.hi & b.hi}; }
  friend Mask operator|(const Mask& a, const Mask& b) { return {a.lo | b.lo, a.hi | b.hi}; }
  friend Mask operator!(const Mask& a) { return {!a.lo, !a.hi}; }
};

template <class T, int N>
struct Pack<T, N, true> {
  using M = Mask<T, N>;
  typedef T Lanes __attribute__((vector_size(N * sizeof(T))));
  mutable Lanes lanes;

  Pack() : lanes{} {}
  Pack(Lanes l) : lanes(l) {}
  template <class U>
  requires std::is_arithmetic_v<U> Pack(U all) : lanes(static_cast<T>(all) - Lanes{}) {}

  static Pack load(const T* from) {
    Pack p;
    __builtin_memcpy(&p.lanes, from, sizeof(Lanes));
    return p;
  }
  void store(T* to) const { __builtin_memcpy(to, &lanes, sizeof(Lanes)); }

  friend Pack operator+(const Pack& a, const Pack& b) { return a.lanes + b.lanes; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.lanes - b.lanes; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.lanes * b.lanes; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.lanes / b.lanes; }
  friend Pack operator-(const Pack& a) { return -a.lanes; }
#ifdef INTERSTICE_AVX512
  template <int How>
  static M compare(const Pack& a, const Pack& b) {
    if constexpr (std::is_same_v<T, float>) {
      if constexpr (N == 16) return {_mm512_cmp_ps_mask(a.lanes, b.lanes, How)};
      if constexpr (N == 8) return {_mm256_cmp_ps_mask(a.lanes, b.lanes, How)};
      if constexpr (N == 4) return {_mm_cmp_ps_mask(a.lanes, b.lanes, How)};
    } else {
      if constexpr (N == 8) return {_mm512_cmp_pd_mask(a.lanes, b.lanes, How)};
      if constexpr (N == 4) return {_mm256_cmp_pd_mask(a.lanes, b.lanes, How)};
      if constexpr (N == 2) return {_mm_cmp_pd_mask(a.lanes, b.lanes, How)};
    }
  }
  friend M operator<(const Pack& a, const Pack& b) { return compare<_CMP_LT_OQ>(a, b); }
  friend M operator>(const Pack& a, const Pack& b) { return compare<_CMP_GT_OQ>(a, b); }
  friend M operator<=(const Pack& a, const Pack& b) { return compare<_CMP_LE_OQ>(a, b); }
  friend M operator>=(const Pack& a, const Pack& b) { return compare<_CMP_GE_OQ>(a, b); }
  friend Pack select(const M& condition, const Pack& yes, const Pack& no) {
    if constexpr (std::is_same_v<T, float>) {
      if constexpr (N == 16)
        return _mm512_mask_blend_ps(static_cast<__mmask16>(condition.lanes), no.lanes, yes.lanes);
      if constexpr (N == 8)
        return _mm256_mask_blend_ps(static_cast<__mmask8>(condition.lanes), no.lanes, yes.lanes);
      if constexpr (N == 4)
        return _mm_mask_blend_ps(static_cast<__mmask8>(condition.lanes), no.lanes, yes.lanes);
    } else {
      if constexpr (N == 8)
        return _mm512_mask_blend_pd(static_cast<__mmask8>(condition.lanes), no.lanes, yes.lanes);
      if constexpr (N == 4)
        return _mm256_mask_blend_pd(static_cast<__mmask8>(condition.lanes), no.lanes, yes.lanes);
      if constexpr (N == 2)
        return _mm_mask_blend_pd(static_cast<__mmask8>(condition.lanes), no.lanes, yes.lanes);
    }
  }
#else
  friend M operator<(const Pack& a, const Pack& b) { return {a.lanes < b.lanes}; }
  friend M operator>(const Pack& a, const Pack& b) { return {a.lanes > b.lanes}; }
  friend M operator<=(const Pack& a, const Pack& b) { return {a.lanes <= b.lanes}; }
  friend M operator>=(const Pack& a, const Pack& b) { return {a.lanes >= b.lanes}; }
  friend Pack select(const M& condition, const Pack& yes, const Pack& no) {
    return condition.lanes ? yes.lanes : no.lanes;
  }
#endif
#ifdef INTERSTICE_AVX512
  // From estimates good to 2^-14, inverses improved by Newton's rule, roots at once by a series: a third of
  // the time of a division or a root, and a unit and a half in the last place off at most.
  static Pack improved_inverse(const Pack& a) {
    constexpr bool single = std::is_same_v<T, float>;
    Pack y;
    if constexpr (single) {
      y.lanes = _mm512_rcp14_ps(a.lanes);
    } else {
      y.lanes = _mm512_rcp14_pd(a.lanes);
    }
    for (int i = 0; i < (single ? 1 : 2); ++i) y = multiply_add(y, subtract_product(a, y, Pack(1)), y);
    return y;
  }
  static Pack estimated_inverse_root(const Pack& a) {
    if constexpr (std::is_same_v<T, float>) {
      return _mm512_rsqrt14_ps(a.lanes);
    } else {
      return _mm512_rsqrt14_pd(a.lanes);
    }
  }
  /// x/sqrt(1 - e) = x + x (e/2 + 3 e^2/8 + 5 e^3/16 + ...): |e| is below 2^-12, so in single precision the
  /// first term is enough, in double the first three.
  static Pack over_root_of_rest(const Pack& x, const Pack& e) {
    if constexpr (std::is_same_v<T, float>) {
      return multiply_add(Pack(0.5) * x, e, x);
    } else {
      const Pack series = multiply_add(multiply_add(Pack(0.3125), e, Pack(0.375)), e, Pack(0.5));
      return multiply_add(x * e, series, x);
    }
  }
  static Pack improved_inverse_root(const Pack& a) {
    const Pack y = estimated_inverse_root(a);
    return over_root_of_rest(y, subtract_product(a * y, y, Pack(1)));
  }
  /// The root itself improved, which is a multiplication shorter than a/sqrt(a); 0 of zero.
  static Pack improved_root(const Pack& a) {
    const Pack y = estimated_inverse_root(a), root = a * y;
    return select(a > Pack(0), over_root_of_rest(root, subtract_product(root, y, Pack(1))), Pack(0));
  }
#endif
  friend Pack inverse_of(const Pack& a) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) return improved_inverse(a);
#endif
    return Pack(1) / a;
  }
  friend Pack inverse_root_of(const Pack& a) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) return improved_inverse_root(a);
#endif
    return Pack(1) / sqrt_of(a);
  }
  /// A unit in the last place off in a whole AVX-512 register, else exact.
  friend Pack sqrt_of(const Pack& a) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) return improved_root(a);
#endif
    Pack r;  // with -fno-math-errno one instruction
    for (int i = 0; i < N; ++i) r.lanes[i] = std::sqrt(a.lanes[i]);
    return r;
  }
  /// a b + c, rounded once where the machine can.
  friend Pack multiply_add(const Pack& a, const Pack& b, const Pack& c) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) {
      if constexpr (std::is_same_v<T, float>) {
        return _mm512_fmadd_ps(a.lanes, b.lanes, c.lanes);
      } else {
        return _mm512_fmadd_pd(a.lanes, b.lanes, c.lanes);
      }
    }
#endif
    return a * b + c;
  }
  /// c - a b, rounded once where the machine can.
  friend Pack subtract_product(const Pack& a, const Pack& b, const Pack& c) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) {
      if constexpr (std::is_same_v<T, float>) {
        return _mm512_fnmadd_ps(a.lanes, b.lanes, c.lanes);
      } else {
        return _mm512_fnmadd_pd(a.lanes, b.lanes, c.lanes);
      }
    }
#endif
    return c - a * b;
  }
  /// The second where they are equal or one is no number, like a select by > or <.
  friend Pack max_of(const Pack& a, const Pack& b) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) {
      if constexpr (std::is_same_v<T, float>) {
        return _mm512_max_ps(a.lanes, b.lanes);
      } else {
        return _mm512_max_pd(a.lanes, b.lanes);
      }
    }
#endif
    return select(a > b, a, b);
  }
  friend Pack min_of(const Pack& a, const Pack& b) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) {
      if constexpr (std::is_same_v<T, float>) {
        return _mm512_min_ps(a.lanes, b.lanes);
      } else {
        return _mm512_min_pd(a.lanes, b.lanes);
      }
    }
#endif
    return select(a < b, a, b);
  }
  friend Pack abs_of(const Pack& a) {
#ifdef INTERSTICE_AVX512
    if constexpr (sizeof(Lanes) == 64) {
      if constexpr (std::is_same_v<T, float>) {
        return _mm512_abs_ps(a.lanes);
      } else {
        return _mm512_abs_pd(a.lanes);
      }
    }
#endif
    return select(a < Pack(0), -a, a);
  }
  template <class F>
  friend Pack each(const Pack& a, const F& f) {
    Pack r;
    for (int i = 0; i < N; ++i) r.lanes[i] = f(a.lanes[i]);
    return r;
  }
};

template <class T, int N>
struct Pack<T, N, false> {
  using M = Mask<T, N>;
  using Half = Pack<T, N / 2>;
  Half lo, hi;

  Pack() = default;
  Pack(const Half& l, const Half& h) : lo(l), hi(h) {}
  template <class U>
  requires std::is_arithmetic_v<U> Pack(U all) : lo(all), hi(all) {}

  static Pack load(const T* from) { return {Half::load(from), Half::load(from + N / 2)}; }
  void store(T* to) const {
    lo.store(to);
    hi.store(to + N / 2);
  }

  friend Pack operator+(const Pack& a, const Pack& b) { return {a.lo + b.lo, a.hi + b.hi}; }
  friend Pack operator-(const Pack& a, const Pack& b) { return {a.lo - b.lo, a.hi - b.hi}; }
  friend Pack operator*(const Pack& a, const Pack& b) { return {a.lo * b.lo, a.hi * b.hi}; }
  friend Pack operator/(const Pack& a, const Pack& b) { return {a.lo / b.lo, a.hi / b.hi}; }
  friend Pack operator-(const Pack& a) { return {-a.lo, -a.hi}; }
  friend M operator<(const Pack& a, const Pack& b) { return {a.lo < b.lo, a.hi < b.hi}; }
  friend M operator>(const Pack& a, const Pack& b) { return {a.lo > b.lo, a.hi > b.hi}; }
  friend M operator<=(const Pack& a, const Pack& b) { return {a.lo <= b.lo, a.hi <= b.hi}; }
  friend M operator>=(const Pack& a, const Pack& b) { return {a.lo >= b.lo, a.hi >= b.hi}; }
  friend Pack select(const M& condition, const Pack& yes, const Pack& no) {
    return {select(condition.lo, yes.lo, no.lo), select(condition.hi, yes.hi, no.hi)};
  }
  friend Pack multiply_add(const Pack& a, const Pack& b, const Pack& c) {
    return {multiply_add(a.lo, b.lo, c.lo), multiply_add(a.hi, b.hi, c.hi)};
  }
  friend Pack subtract_product(const Pack& a, const Pack& b, const Pack& c) {
    return {subtract_product(a.lo, b.lo, c.lo), subtract_product(a.hi, b.hi, c.hi)};
  }
  friend Pack sqrt_of(const Pack& a) { return {sqrt_of(a.lo), sqrt_of(a.hi)}; }
  friend Pack max_of(const Pack& a, const Pack& b) { return {max_of(a.lo, b.lo), max_of(a.hi, b.hi)}; }
  friend Pack min_of(const Pack& a, const Pack& b) { return {min_of(a.lo, b.lo), min_of(a.hi, b.hi)}; }
  friend Pack abs_of(const Pack& a) { return {abs_of(a.lo), abs_of(a.hi)}; }
  friend Pack inverse_of(const Pack& a) { return {inverse_of(a.lo), inverse_of(a.hi)}; }
  friend Pack inverse_root_of(const Pack& a) { return {inverse_root_of(a.lo), inverse_root_of(a.hi)}; }
  template <class F>
  friend Pack each(const Pack& a, const F& f) {
    return {each(a.lo, f), each(a.hi, f)};
  }
};

template <class T, int N>
bool everywhere(const Mask<T, N>& condition) {
  return condition.bits() == (1u << N) - 1;
}
template <class T, int N>
Pack<T, N>& operator+=(Pack<T, N>& a, const Pack<T, N>& b) {
  return a = a + b;
}
/// The nearest whole number, of numbers below 2^22 (2^51) in single (double).
template <class T, int N>
Pack<T, N> rounded(const Pack<T, N>& a) {
  const Pack<T, N> large(sizeof(T) == 4 ? 12582912.0 : 6755399441055744.0);
  return (a + large) - large;
}
template <class T, int N>
Pack<T, N> cbrt_of(const Pack<T, N>& a) {
  return each(a, [](T x) { return std::cbrt(x); });
}
/// For norm() of base/vec3.h.
template <class T, int N>
Pack<T, N> sqrt(const Pack<T, N>& a) {
  return sqrt_of(a);
}

/// Of vectors of packs, fused in one way only: left to the compiler, it might be one way in one half of a
/// pack and another way in the other.
template <class T, int N>
Pack<T, N> dot(const Vec3<Pack<T, N>>& a, const Vec3<Pack<T, N>>& b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}
template <class T, int N>
Vec3<Pack<T, N>> cross(const Vec3<Pack<T, N>>& a, const Vec3<Pack<T, N>>& b) {
  return {multiply_add(a.y, b.z, -(a.z * b.y)), multiply_add(a.z, b.x, -(a.x * b.z)),
          multiply_add(a.x, b.y, -(a.y * b.x))};
}

/// As in contact/numeric.h.
template <class T, int N>
Pack<T, N> inverse_length_of(const Vec3<Pack<T, N>>& v) {
  return inverse_length<Pack<T, N>, T>(v);
}
template <class T, int N>
Pack<T, N> inverse_spin_of(const Vec3<Pack<T, N>>& v) {
  return inverse_spin<Pack<T, N>, T>(v);
}

namespace detail {
template <int first, class V, int... I>
auto lanes_from(const V& v, std::integer_sequence<int, I...>) {
  return __builtin_shufflevector(v, v, (first + I)...);
}
template <class V, int... I>
auto joined(const V& lo, const V& hi, std::integer_sequence<int, I...>) {
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 32) {  // what the compiler makes of the general form takes three instructions
    typedef std::remove_cvref_t<decltype(lo[0])> Number;
    typedef Number Whole __attribute__((vector_size(64)));
    return reinterpret_cast<Whole>(_mm512_insertf64x4(_mm512_castpd256_pd512(reinterpret_cast<__m256d>(lo)),
                                                      reinterpret_cast<__m256d>(hi), 1));
  } else
#endif
    return __builtin_shufflevector(lo, hi, I...);
}
}  // namespace detail

/// The first and the last lanes.
template <class T, int N>
Pack<T, N / 2> lower_half(const Pack<T, N>& a) {
  if constexpr (kFitsRegister<T, N>) {
    return detail::lanes_from<0>(a.lanes, std::make_integer_sequence<int, N / 2>{});
  } else {
    return a.lo;
  }
}
template <class T, int N>
Pack<T, N / 2> upper_half(const Pack<T, N>& a) {
  if constexpr (kFitsRegister<T, N>) {
    return detail::lanes_from<N / 2>(a.lanes, std::make_integer_sequence<int, N / 2>{});
  } else {
    return a.hi;
  }
}

/// The same numbers as another scalar type.
template <class U, class T, int N>
Pack<U, N> converted(const Pack<T, N>& a) {
  if constexpr (std::is_same_v<U, T>) {
    return a;
  } else if constexpr (kFitsRegister<T, N> && kFitsRegister<U, N>) {
#ifdef INTERSTICE_AVX512
    // What the compiler makes of the general form takes four instructions.
    if constexpr (std::is_same_v<U, double> && N == 8)
      return _mm512_cvtps_pd(reinterpret_cast<__m256>(a.lanes));
    else
#endif
      return __builtin_convertvector(a.lanes, typename Pack<U, N>::Lanes);
  } else if constexpr (kFitsRegister<U, N>) {  // two registers of doubles to one of floats
    // Not through memory: what is written in two pieces cannot be read as one until it has reached the cache.
    return detail::joined(converted<U>(a.lo).lanes, converted<U>(a.hi).lanes,
                          std::make_integer_sequence<int, N>{});
  } else if constexpr (kFitsRegister<T, N>) {
    return {converted<U>(lower_half(a)), converted<U>(upper_half(a))};
  } else {
    return {converted<U>(a.lo), converted<U>(a.hi)};
  }
}
namespace detail {
template <int a, int b, int M, class V, int... I>
auto two_of(const V& v, const V& w, std::integer_sequence<int, I...>) {
  return __builtin_shufflevector(v, w, (I < M / 2 ? a : b)...);
}
}  // namespace detail

/// M lanes of which the lower half are lane `a` of a pack, the upper half its lane `b`.
template <int a, int b, int M, class T, int N>
Pack<T, M> halves_of(const Pack<T, N>& p) {
  constexpr auto all = std::make_integer_sequence<int, M>{};
  if constexpr (!kFitsRegister<T, M>) {
    return {halves_of<a, a, M / 2>(p), halves_of<b, b, M / 2>(p)};
  } else if constexpr (kFitsRegister<T, N>) {
    return detail::two_of<a, b, M>(p.lanes, p.lanes, all);
  } else if constexpr (kFitsRegister<T, N / 2>) {
    return detail::two_of<a, b, M>(p.lo.lanes, p.hi.lanes, all);
  } else {
    static_assert(a == b, "two registers at once are enough");
    return a < N / 2 ? halves_of<a % (N / 2), b % (N / 2), M>(p.lo)
                     : halves_of<a % (N / 2), b % (N / 2), M>(p.hi);
  }
}

/// Lane i of the result is lane from[i]; N = 16.
template <class T, int N>
Pack<T, N> permuted(const Pack<T, N>& p, const std::uint8_t* from) {
  static_assert(N == 16);
#ifdef INTERSTICE_AVX512
  const __m128i lanes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
  if constexpr (std::is_same_v<T, float>) {
    return Pack<T, N>(_mm512_permutexvar_ps(_mm512_cvtepu8_epi32(lanes), p.lanes));
  } else {
    const auto half = [&](const __m128i& eight) {
      return Pack<T, N / 2>(_mm512_permutex2var_pd(p.lo.lanes, _mm512_cvtepu8_epi64(eight), p.hi.lanes));
    };
    return {half(lanes), half(_mm_unpackhi_epi64(lanes, lanes))};
  }
#else
  T before[N], after[N];
  p.store(before);
  for (int i = 0; i < N; ++i) after[i] = before[from[i]];
  return Pack<T, N>::load(after);
#endif
}

/// Whole numbers as a pack.
template <class T, int N>
Pack<T, N> from_counts(const std::uint32_t* counts) {
  if constexpr (kFitsRegister<T, N>) {
    typedef std::uint32_t Counts __attribute__((vector_size(N * sizeof(std::uint32_t))));
    Counts c;
    __builtin_memcpy(&c, counts, sizeof(c));
    return __builtin_convertvector(c, typename Pack<T, N>::Lanes);
  } else {
    return {from_counts<T, N / 2>(counts), from_counts<T, N / 2>(counts + N / 2)};
  }
}
template <class U, class T, int N>
Vec3<Pack<U, N>> converted(const Vec3<Pack<T, N>>& a) {
  return {converted<U>(a.x), converted<U>(a.y), converted<U>(a.z)};
}

}  // namespace interstice::dem::simd
