// Rows of memory to packs and back: lane i of each pack is what row i holds side by side. Thirty-two bytes of
// a row, four doubles or eight floats, are loaded or stored at once and reordered in registers, which is far
// faster than gathering number by number. Rows are visited one after the other, so that an address is needed
// once.
//
// In registers: 16-byte blocks of as many rows as a block has numbers are turned like a small square matrix,
// which takes instructions that stay within blocks; what is left is whole blocks changing places.
#pragma once

#include <array>
#include <utility>

#include "dem/simd/pack.h"

namespace interstice::dem::simd {

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

/// The row that begins `offset` doubles after the first.
template <class Row>
const Row* row_at(const void* first, std::uint32_t offset) {
  return reinterpret_cast<const Row*>(static_cast<const double*>(first) + offset);
}
template <class Row>
Row* row_at(void* first, std::uint32_t offset) {
  return reinterpret_cast<Row*>(static_cast<double*>(first) + offset);
}

#if defined(__AVX__)
namespace detail {

/// Numbers in a block of 16 bytes.
template <class T>
inline constexpr int kPerBlock = 16 / static_cast<int>(sizeof(T));

/// Where a row of 32 bytes lies in a set of registers that holds as many rows as a register has lanes.
template <class T>
struct RowPlace {
  static constexpr int rows_per_register = kNativeBytes / 32;
  static constexpr int registers = 2 * kPerBlock<T>;  // of a set

  static constexpr int set(int row) { return row / kNativeLanes<T>; }
  static constexpr int index(int row) {
    const int in_set = row % kNativeLanes<T>;
    return in_set % kPerBlock<T> + kPerBlock<T> * (in_set / (kPerBlock<T> * rows_per_register));
  }
  static constexpr int half(int row) { return row / kPerBlock<T> % rows_per_register; }
};

template <int half, class V>
void set_row(V& v, const __m256d& row) {
  if constexpr (sizeof(V) == 32) v = reinterpret_cast<V>(row);
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) {
    v = half == 0 ? reinterpret_cast<V>(_mm512_castpd256_pd512(row))
                  : reinterpret_cast<V>(_mm512_insertf64x4(reinterpret_cast<__m512d>(v), row, 1));
  }
#endif
}
template <int half, class V>
__m256d row_of(const V& v) {
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) return _mm512_extractf64x4_pd(reinterpret_cast<__m512d>(v), half);
#endif
  if constexpr (sizeof(V) == 32) return reinterpret_cast<__m256d>(v);
}

/// Interleaves numbers of type T of the lower or upper half of every block.
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

/// Every other block of a, then of b, from the first or the second on.
template <bool second, class V>
V every_other(const V& a, const V& b) {
  if constexpr (sizeof(V) == 32) {
    return reinterpret_cast<V>(_mm256_permute2f128_pd(reinterpret_cast<__m256d>(a),
                                                      reinterpret_cast<__m256d>(b), second ? 0x31 : 0x20));
  }
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) {
    return reinterpret_cast<V>(_mm512_shuffle_f64x2(reinterpret_cast<__m512d>(a),
                                                    reinterpret_cast<__m512d>(b), second ? 0xdd : 0x88));
  }
#endif
}
/// Blocks of a and b in turns, those of their lower or upper halves.
template <bool upper, class V>
V in_turns(const V& a, const V& b) {
  if constexpr (sizeof(V) == 32) return every_other<upper>(a, b);
#ifdef INTERSTICE_AVX512
  if constexpr (sizeof(V) == 64) {
    const __m512i from =
        upper ? _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15) : _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    return reinterpret_cast<V>(
        _mm512_permutex2var_pd(reinterpret_cast<__m512d>(a), from, reinterpret_cast<__m512d>(b)));
  }
#endif
}

/// Number i of each block of register j becomes number j of that block of register i.
template <class T, class V>
void turn_blocks(V* v) {
  if constexpr (sizeof(T) == 8) {
    const V a = v[0], b = v[1];
    v[0] = interleave<T, false>(a, b), v[1] = interleave<T, true>(a, b);
  } else {
    const V ab01 = interleave<T, false>(v[0], v[1]), ab23 = interleave<T, true>(v[0], v[1]);
    const V cd01 = interleave<T, false>(v[2], v[3]), cd23 = interleave<T, true>(v[2], v[3]);
    v[0] = interleave<double, false>(ab01, cd01), v[1] = interleave<double, true>(ab01, cd01);
    v[2] = interleave<double, false>(ab23, cd23), v[3] = interleave<double, true>(ab23, cd23);
  }
}

/// Piece i of 32 bytes of a pack of 64 bytes.
template <int i, class T, int N>
__m256d piece(const Pack<T, N>& p) {
  static_assert(N * sizeof(T) == 64);
  if constexpr (kNativeBytes == 64) {
    return row_of<i>(p.lanes);
  } else {
    return reinterpret_cast<__m256d>(i == 0 ? p.lo.lanes : p.hi.lanes);
  }
}

/// 32 bytes of each of N rows, in registers.
template <class T, int N>
struct RowSet {
  using V = typename Pack<T, kNativeLanes<T>>::Lanes;
  using Place = RowPlace<T>;
  static constexpr int kSets = N / kNativeLanes<T>, kColumns = Place::registers;
  mutable V v[kSets][kColumns];

  template <int row>
  void set(const __m256d& r) {
    set_row<Place::half(row)>(v[Place::set(row)][Place::index(row)], r);
  }
  template <int row>
  __m256d get() const {
    return row_of<Place::half(row)>(v[Place::set(row)][Place::index(row)]);
  }
  std::array<Pack<T, N>, kColumns> columns() const {
    constexpr int half = kColumns / 2;
    V c[kColumns][kSets];
    unrolled<kSets>([&](auto set) {
      V turned[kColumns];
      unrolled<kColumns>([&](auto j) { turned[j] = v[set][j]; });
      turn_blocks<T>(turned), turn_blocks<T>(turned + half);
      unrolled<half>([&](auto j) {
        c[j][set] = every_other<false>(turned[j], turned[half + j]);
        c[half + j][set] = every_other<true>(turned[j], turned[half + j]);
      });
    });
    return packs_of(c, std::make_index_sequence<kColumns>{});
  }
  template <std::size_t... J>
  static std::array<Pack<T, N>, kColumns> packs_of(const V (&c)[kColumns][kSets], std::index_sequence<J...>) {
    return {assembled<T, N>(c[J])...};
  }
};

}  // namespace detail
#endif

template <class P>
using Octs = std::array<P, 8>;

/// The order of rows of eight floats in memory in which registers filled one after the other hold them as
/// they are needed: the place of row `row`.
constexpr int place_of_row(int row) {
#if defined(__AVX__)
  using Place = detail::RowPlace<float>;
  return kNativeLanes<float> * Place::set(row) + Place::rows_per_register * Place::index(row) +
         Place::half(row);
#else
  return row;
#endif
}

/// Collects four doubles of each of N rows.
template <int N>
class QuadLoader {
 public:
  using P = Pack<double, N>;
#if defined(__AVX__)
  template <int row>
  void load(const double* p) {
    rows_.template set<row>(_mm256_loadu_pd(p));
  }
  /// Three differences a - b and one sum.
  template <int row>
  void load_difference(const double* a, const double* b) {
#if defined(__FMA__)
    const __m256d signs = _mm256_setr_pd(-1, -1, -1, 1);
    rows_.template set<row>(_mm256_fmadd_pd(_mm256_loadu_pd(b), signs, _mm256_loadu_pd(a)));
#else
    const __m256d signs = _mm256_setr_pd(-0.0, -0.0, -0.0, 0.0);
    rows_.template set<row>(_mm256_add_pd(_mm256_xor_pd(_mm256_loadu_pd(b), signs), _mm256_loadu_pd(a)));
#endif
  }
  std::array<P, 4> columns() const { return rows_.columns(); }

 private:
  detail::RowSet<double, N> rows_;
#else
  template <int row>
  void load(const double* p) {
    for (int j = 0; j < 4; ++j) columns_[j][row] = p[j];
  }
  template <int row>
  void load_difference(const double* a, const double* b) {
    for (int j = 0; j < 4; ++j) columns_[j][row] = j < 3 ? a[j] - b[j] : a[j] + b[j];
  }
  std::array<P, 4> columns() const {
    return {P::load(columns_[0]), P::load(columns_[1]), P::load(columns_[2]), P::load(columns_[3])};
  }

 private:
  double columns_[4][N];
#endif
};

/// Collects eight numbers of type T of each of N rows.
template <class T, int N>
class OctLoader {
 public:
  using P = Pack<T, N>;
#if defined(__AVX__)
  template <int row>
  void load(const T* p) {
    if constexpr (sizeof(T) == 8) {
      rows_[0].template set<row>(_mm256_loadu_pd(p));
      rows_[1].template set<row>(_mm256_loadu_pd(p + 4));
    } else {
      rows_[0].template set<row>(_mm256_castps_pd(_mm256_loadu_ps(p)));
    }
  }
  /// Row by row from registers, in the order of place_of_row.
  void take(const Pack<T, 64 / sizeof(T)>* packs) {
    unrolled<N>([&](auto index) {
      constexpr int row = decltype(index)::value, place = place_of_row(row);
      if constexpr (sizeof(T) == 8) {
        rows_[0].template set<row>(detail::piece<0>(packs[place]));
        rows_[1].template set<row>(detail::piece<1>(packs[place]));
      } else {
        rows_[0].template set<row>(detail::piece<place % 2>(packs[place / 2]));
      }
    });
  }
  Octs<P> columns() const {
    if constexpr (sizeof(T) == 8) {
      const auto lo = rows_[0].columns(), hi = rows_[1].columns();
      return {lo[0], lo[1], lo[2], lo[3], hi[0], hi[1], hi[2], hi[3]};
    } else {
      return rows_[0].columns();
    }
  }

 private:
  detail::RowSet<T, N> rows_[sizeof(T) / 4];
#else
  template <int row>
  void load(const T* p) {
    for (int j = 0; j < 8; ++j) columns_[j][row] = p[j];
  }
  void take(const Pack<T, 64 / sizeof(T)>* packs) {
    T rows[N * 8];
    for (int i = 0; i < N * static_cast<int>(sizeof(T)) / 8; ++i) packs[i].store(rows + i * (64 / sizeof(T)));
    unrolled<N>([&](auto row) { load<decltype(row)::value>(rows + 8 * decltype(row)::value); });
  }
  Octs<P> columns() const {
    Octs<P> packs;
    for (std::size_t j = 0; j < 8; ++j) packs[j] = P::load(columns_[j]);
    return packs;
  }

 private:
  T columns_[8][N];
#endif
};

/// Four numbers of type T of each of N rows, to be stored.
template <class T, int N>
class Quads {
 public:
  using P = Pack<T, N>;
#if defined(__AVX__)
  Quads(const P& a, const P& b, const P& c, const P& d) {
    using namespace detail;
    unrolled<kSets>([&](auto set) {
      constexpr int lane = decltype(set)::value * kNativeLanes<T>;
      V* const r = registers_[set];
      r[0] = register_at<lane>(a), r[1] = register_at<lane>(b);
      r[2] = register_at<lane>(c), r[3] = register_at<lane>(d);
      turn_blocks<T>(r);
      if constexpr (sizeof(T) == 8) {  // two blocks a row
        turn_blocks<T>(r + 2);
        const V even = in_turns<false>(r[0], r[2]), odd = in_turns<false>(r[1], r[3]);
        r[2] = in_turns<true>(r[0], r[2]), r[3] = in_turns<true>(r[1], r[3]);
        r[0] = even, r[1] = odd;
      }
    });
  }
  Quads operator-() const {
    Quads q(*this);
    unrolled<kSets * 4>([&](auto i) { q.registers_[i / 4][i % 4] = -q.registers_[i / 4][i % 4]; });
    return q;
  }
  template <int row>
  void store(double* to) const {
    _mm256_storeu_pd(to, get<row>());
  }
  /// Leaves what follows the three as it is.
  template <int row>
  void store_three(double* to) const {
    _mm256_maskstore_pd(to, _mm256_setr_epi64x(-1, -1, -1, 0), get<row>());
  }

 private:
  template <class, int>
  friend class OctStorer;
  using V = typename Pack<T, kNativeLanes<T>>::Lanes;
  static constexpr int kSets = N / kNativeLanes<T>;

  template <int row>
  __m256d get() const {
    static_assert(sizeof(T) == 8, "four floats are half a row");
    using Place = detail::RowPlace<T>;
    return detail::row_of<Place::half(row)>(registers_[Place::set(row)][Place::index(row)]);
  }

  mutable V registers_[kSets][4];
#else
  Quads(const P& a, const P& b, const P& c, const P& d) {
    a.store(columns_[0]), b.store(columns_[1]), c.store(columns_[2]), d.store(columns_[3]);
  }
  Quads operator-() const {
    Quads q(*this);
    for (auto& column : q.columns_)
      for (T& number : column) number = -number;
    return q;
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

/// Puts eight numbers of type T into each of N rows.
template <class T, int N>
class OctStorer {
 public:
  OctStorer(const Quads<T, N>& first, const Quads<T, N>& last) : first_(first), last_(last) {}
  template <int row>
  void store(T* to) const {
    first_.template store<row>(to), last_.template store<row>(to + 4);
  }

 private:
  Quads<T, N> first_, last_;
};

#if defined(__AVX__)
template <int N>
class OctStorer<float, N> {
 public:
  OctStorer(const Quads<float, N>& first, const Quads<float, N>& last) {
    unrolled<4 * detail::RowSet<float, N>::kSets>([&](auto i) {
      constexpr int set = decltype(i)::value / 4, j = decltype(i)::value % 4;
      const auto &lo = first.registers_[set][j], &hi = last.registers_[set][j];
      rows_.v[set][j] = detail::in_turns<false>(lo, hi);
      rows_.v[set][4 + j] = detail::in_turns<true>(lo, hi);
    });
  }
  template <int row>
  void store(float* to) const {
    _mm256_storeu_pd(reinterpret_cast<double*>(to), rows_.template get<row>());
  }

 private:
  detail::RowSet<float, N> rows_;
};
#endif

}  // namespace interstice::dem::simd
