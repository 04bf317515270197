// Rows of memory to packs and back: lane i of four packs is what row i holds side by side. Sixteen bytes at a
// time are put together in a register and reordered there, which is far faster than gathering field by field.
// Rows are visited one after the other, so that an address is needed once.
#pragma once

#include <utility>

#include "dem/simd/pack.h"

namespace interstice::dem::simd {

/// Four numbers of each row.
template <class P>
struct Quad {
  P a, b, c, d;
};

/// Lanes of a register.
template <class T>
inline constexpr int kNativeLanes = kNativeBytes / static_cast<int>(sizeof(T));

/// A pack of N lanes from the registers that it is made of.
template <class T, int N>
Pack<T, N> assembled(const typename Pack<T, kNativeLanes<T>>::Lanes* registers) {
  if constexpr (N == kNativeLanes<T>) {
    return registers[0];
  } else {
    return {assembled<T, N / 2>(registers), assembled<T, N / 2>(registers + N / 2 / kNativeLanes<T>)};
  }
}
/// The register that holds lanes [lane, lane + kNativeLanes).
template <int lane, class T, int N>
auto register_at(const Pack<T, N>& p) {
  if constexpr (N == kNativeLanes<T>) {
    return p.lanes;
  } else if constexpr (lane < N / 2) {
    return register_at<lane>(p.lo);
  } else {
    return register_at<lane - N / 2>(p.hi);
  }
}

/// Calls body with the integral constants 0 to n - 1.
template <int n, class Body>
void unrolled(const Body& body) {
  [&]<int... I>(std::integer_sequence<int, I...>) { (body(std::integral_constant<int, I>{}), ...); }
  (std::make_integer_sequence<int, n>{});
}

#if defined(__AVX__)
namespace detail {

/// Puts the 16 bytes at p into block `at` of a register.
template <int at, class V>
void set_block(V& v, const void* p) {
  const __m128 block = _mm_loadu_ps(static_cast<const float*>(p));
  if constexpr (sizeof(V) == 32) {
    v = at == 0 ? reinterpret_cast<V>(_mm256_castps128_ps256(block))
                : reinterpret_cast<V>(_mm256_insertf128_ps(reinterpret_cast<__m256>(v), block, 1));
  }
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) {
    v = at == 0 ? reinterpret_cast<V>(_mm512_castps128_ps512(block))
                : reinterpret_cast<V>(_mm512_insertf32x4(reinterpret_cast<__m512>(v), block, at));
  }
#endif
}

template <int at, class V>
__m128 block_of(const V& v) {
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) return _mm512_extractf32x4_ps(reinterpret_cast<__m512>(v), at);
#endif
  if constexpr (sizeof(V) == 32) return _mm256_extractf128_ps(reinterpret_cast<__m256>(v), at);
}

/// Interleaves numbers of type T of the lower or upper half of every 16 bytes.
template <class T, bool upper, class V>
V interleave(const V& a, const V& b) {
  if constexpr (sizeof(V) == 32) {
    const auto x = reinterpret_cast<__m256>(a), y = reinterpret_cast<__m256>(b);
    const auto p = reinterpret_cast<__m256d>(a), q = reinterpret_cast<__m256d>(b);
    if constexpr (sizeof(T) == 4) {
      return reinterpret_cast<V>(upper ? _mm256_unpackhi_ps(x, y) : _mm256_unpacklo_ps(x, y));
    } else {
      return reinterpret_cast<V>(upper ? _mm256_unpackhi_pd(p, q) : _mm256_unpacklo_pd(p, q));
    }
  }
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) {
    const auto x = reinterpret_cast<__m512>(a), y = reinterpret_cast<__m512>(b);
    const auto p = reinterpret_cast<__m512d>(a), q = reinterpret_cast<__m512d>(b);
    if constexpr (sizeof(T) == 4) {
      return reinterpret_cast<V>(upper ? _mm512_unpackhi_ps(x, y) : _mm512_unpacklo_ps(x, y));
    } else {
      return reinterpret_cast<V>(upper ? _mm512_unpackhi_pd(p, q) : _mm512_unpacklo_pd(p, q));
    }
  }
#endif
}

}  // namespace detail
#endif

/// Collects four numbers of type T of each of N rows.
template <class T, int N>
class QuadLoader {
 public:
#if defined(__AVX__)
  /// The numbers at p belong to this row.
  template <int row>
  void load(const std::byte* p) {
    constexpr int at = row % kNativeLanes<T> / kPerBlock;
    unrolled<kHalves>([&](auto half) {
      constexpr int h = decltype(half)::value;
      detail::set_block<at>(blocks_[h][row % kPerBlock][row / kNativeLanes<T>], p + 16 * h);
    });
  }
  Quad<Pack<T, N>> quad() const {
    using namespace detail;
    V columns[4][kRegisters];
    unrolled<kRegisters>([&](auto index) {
      constexpr int r = decltype(index)::value;
      if constexpr (sizeof(T) == 8) {
        unrolled<2>([&](auto which) {
          constexpr int half = decltype(which)::value;
          columns[2 * half][r] = interleave<T, false>(blocks_[half][0][r], blocks_[half][1][r]);
          columns[2 * half + 1][r] = interleave<T, true>(blocks_[half][0][r], blocks_[half][1][r]);
        });
      } else {
        const auto& b = blocks_[0];
        const V ab01 = interleave<T, false>(b[0][r], b[1][r]), ab23 = interleave<T, false>(b[2][r], b[3][r]);
        const V cd01 = interleave<T, true>(b[0][r], b[1][r]), cd23 = interleave<T, true>(b[2][r], b[3][r]);
        columns[0][r] = interleave<double, false>(ab01, ab23);
        columns[1][r] = interleave<double, true>(ab01, ab23);
        columns[2][r] = interleave<double, false>(cd01, cd23);
        columns[3][r] = interleave<double, true>(cd01, cd23);
      }
    });
    return {assembled<T, N>(columns[0]), assembled<T, N>(columns[1]), assembled<T, N>(columns[2]),
            assembled<T, N>(columns[3])};
  }

 private:
  using V = typename Pack<T, kNativeLanes<T>>::Lanes;
  static constexpr int kPerBlock = 16 / static_cast<int>(sizeof(T)), kHalves = sizeof(T) == 8 ? 2 : 1;
  static constexpr int kRegisters = N / kNativeLanes<T>;
  V blocks_[kHalves][kPerBlock][kRegisters];
#else
  template <int row>
  void load(const std::byte* p) {
    for (std::size_t j = 0; j < 4; ++j) __builtin_memcpy(&columns_[j][row], p + sizeof(T) * j, sizeof(T));
  }
  Quad<Pack<T, N>> quad() const {
    using P = Pack<T, N>;
    return {P::load(columns_[0]), P::load(columns_[1]), P::load(columns_[2]), P::load(columns_[3])};
  }

 private:
  T columns_[4][N];
#endif
};

/// Puts four numbers of type T, or the first three of them, into each of N rows.
template <class T, int N>
class QuadStorer {
 public:
#if defined(__AVX__)
  explicit QuadStorer(const Quad<Pack<T, N>>& q) {
    unrolled<kRegisters>([&](auto r) {
      using namespace detail;
      constexpr int lane = decltype(r)::value * kNativeLanes<T>;
      const V a = register_at<lane>(q.a), b = register_at<lane>(q.b), c = register_at<lane>(q.c),
              d = register_at<lane>(q.d);
      if constexpr (sizeof(T) == 8) {
        blocks_[0][0][r] = interleave<T, false>(a, b), blocks_[0][1][r] = interleave<T, true>(a, b);
        blocks_[1][0][r] = interleave<T, false>(c, d), blocks_[1][1][r] = interleave<T, true>(c, d);
      } else {
        const V ab01 = interleave<T, false>(a, b), ab23 = interleave<T, true>(a, b);
        const V cd01 = interleave<T, false>(c, d), cd23 = interleave<T, true>(c, d);
        blocks_[0][0][r] = interleave<double, false>(ab01, cd01);
        blocks_[0][1][r] = interleave<double, true>(ab01, cd01);
        blocks_[0][2][r] = interleave<double, false>(ab23, cd23);
        blocks_[0][3][r] = interleave<double, true>(ab23, cd23);
      }
    });
  }
  template <int row>
  void store(T* to) const {
    for (int b = 0; b < kBlocks; ++b)
      _mm_storeu_ps(reinterpret_cast<float*>(to + b * kPerBlock), block<row>(b));
  }
  /// Leaves what follows the three as it is.
  template <int row>
  void store_three(T* to) const {
    if constexpr (sizeof(T) == 8) {
      _mm_storeu_ps(reinterpret_cast<float*>(to), block<row>(0));
      _mm_storel_pd(to + 2, _mm_castps_pd(block<row>(1)));
    } else {
      _mm_maskstore_ps(to, _mm_setr_epi32(-1, -1, -1, 0), block<row>(0));
    }
  }

 private:
  using V = typename Pack<T, kNativeLanes<T>>::Lanes;
  static constexpr int kPerBlock = 16 / static_cast<int>(sizeof(T)), kRegisters = N / kNativeLanes<T>;
  static constexpr int kBlocks = sizeof(T) == 8 ? 2 : 1;

  template <int row>
  __m128 block(int b) const {
    constexpr int at = row % kNativeLanes<T> / kPerBlock;
    return detail::block_of<at>(blocks_[b][row % kPerBlock][row / kNativeLanes<T>]);
  }

  V blocks_[kBlocks][kPerBlock][kRegisters];
#else
  explicit QuadStorer(const Quad<Pack<T, N>>& q) {
    q.a.store(columns_[0]), q.b.store(columns_[1]), q.c.store(columns_[2]), q.d.store(columns_[3]);
  }
  template <int row>
  void store(T* to) const {
    for (int j = 0; j < 4; ++j) to[j] = columns_[j][row];
  }
  template <int row>
  void store_three(T* to) const {
    for (int j = 0; j < 3; ++j) to[j] = columns_[j][row];
  }

 private:
  T columns_[4][N];
#endif
};

}  // namespace interstice::dem::simd
