#pragma once
// A pack: the same quantity of W neighbouring elements, in one SIMD register; and the exchange of (x, y) pairs between
// node arrays and packs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace gneiss {

using Pack = xsimd::batch<double>;
inline constexpr std::size_t pack_width = Pack::size;

/// Bytes that arrays loaded as packs are aligned to.
inline constexpr std::size_t pack_alignment = Pack::arch_type::alignment() < 16 ? 16 : Pack::arch_type::alignment();

/// n rounded up to whole packs.
constexpr std::size_t padded(std::size_t n) { return (n + pack_width - 1) / pack_width * pack_width; }

/// Where a pair stands: by its number, or by its distance in bytes from the first pair. Bytes save a shift for every
/// pair.
struct PairNumber {
    std::int32_t value;
};
struct PairBytes {
    std::uint16_t value;
};
inline constexpr std::size_t bytes_per_pair = 2 * sizeof(double);

template <class Value>
Value* pair_at(Value* values, PairNumber i) {
    return values + 2 * static_cast<std::ptrdiff_t>(i.value);
}
inline const double* pair_at(const double* values, PairBytes offset) {
    return reinterpret_cast<const double*>(reinterpret_cast<const char*>(values) + offset.value);
}
inline double* pair_at(double* values, PairBytes offset) {
    return reinterpret_cast<double*>(reinterpret_cast<char*>(values) + offset.value);
}

/// Bit i is set where a condition holds in lane i.
inline std::uint64_t lane_bits(const Pack::batch_bool_type& condition) {
#if defined(__AVX512F__)
    return static_cast<std::uint64_t>(condition.data);
#elif defined(__AVX__)
    return static_cast<std::uint64_t>(_mm256_movemask_pd(condition.data));
#else
    std::uint64_t bits = 0;
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        bits |= static_cast<std::uint64_t>(condition.get(lane)) << lane;
    return bits;
#endif
}

/// Upper half to lower half until one is left: the same bits under every version of xsimd, whose own sum has changed
/// its name.
inline double sum_of_lanes(const Pack& pack) {
    alignas(pack_alignment) std::array<double, pack_width> lanes;
    pack.store_aligned(lanes.data());
    for (std::size_t width = pack_width / 2; width > 0; width /= 2)
        for (std::size_t i = 0; i < width; ++i) lanes[i] += lanes[i + width];
    return lanes[0];
}

/// Gathers W pairs into an x and a y pack.
/// @param index  PairNumber or PairBytes, shape (pack_width)
template <class Index>
inline void gather_pairs(const double* values, const Index* index, Pack& x, Pack& y) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    // Even lanes in one register, odd lanes in the other: unpacking then restores the order.
    const auto pair = [&](int lane) { return _mm_loadu_pd(pair_at(values, index[lane])); };
    __m512d even = _mm512_castpd128_pd512(pair(0));
    __m512d odd = _mm512_castpd128_pd512(pair(1));
    even = _mm512_insertf64x2(even, pair(2), 1);
    odd = _mm512_insertf64x2(odd, pair(3), 1);
    even = _mm512_insertf64x2(even, pair(4), 2);
    odd = _mm512_insertf64x2(odd, pair(5), 2);
    even = _mm512_insertf64x2(even, pair(6), 3);
    odd = _mm512_insertf64x2(odd, pair(7), 3);
    x = Pack(_mm512_unpacklo_pd(even, odd));
    y = Pack(_mm512_unpackhi_pd(even, odd));
#elif defined(__AVX2__)
    const auto pair = [&](int lane) { return _mm_loadu_pd(pair_at(values, index[lane])); };
    const __m256d even = _mm256_insertf128_pd(_mm256_castpd128_pd256(pair(0)), pair(2), 1);
    const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(pair(1)), pair(3), 1);
    x = Pack(_mm256_unpacklo_pd(even, odd));
    y = Pack(_mm256_unpackhi_pd(even, odd));
#else
    alignas(pack_alignment) std::array<double, pack_width> xs, ys;
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        xs[lane] = pair_at(values, index[lane])[0];
        ys[lane] = pair_at(values, index[lane])[1];
    }
    x = Pack::load_aligned(xs.data());
    y = Pack::load_aligned(ys.data());
#endif
}

/// Adds W pairs (x, y) to those that stand in `values`, lane after lane: an index may occur more than once.
template <class Index>
inline void scatter_add_pairs(double* values, const Index* index, const Pack& x, const Pack& y) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    const auto add = [&](int lane, __m128d pair) {
        double* target = pair_at(values, index[lane]);
        _mm_storeu_pd(target, _mm_add_pd(_mm_loadu_pd(target), pair));
    };
    const __m512d even = _mm512_unpacklo_pd(x, y);
    const __m512d odd = _mm512_unpackhi_pd(x, y);
    add(0, _mm512_castpd512_pd128(even));
    add(1, _mm512_castpd512_pd128(odd));
    add(2, _mm512_extractf64x2_pd(even, 1));
    add(3, _mm512_extractf64x2_pd(odd, 1));
    add(4, _mm512_extractf64x2_pd(even, 2));
    add(5, _mm512_extractf64x2_pd(odd, 2));
    add(6, _mm512_extractf64x2_pd(even, 3));
    add(7, _mm512_extractf64x2_pd(odd, 3));
#elif defined(__AVX2__)
    const auto add = [&](int lane, __m128d pair) {
        double* target = pair_at(values, index[lane]);
        _mm_storeu_pd(target, _mm_add_pd(_mm_loadu_pd(target), pair));
    };
    const __m256d even = _mm256_unpacklo_pd(x, y);
    const __m256d odd = _mm256_unpackhi_pd(x, y);
    add(0, _mm256_castpd256_pd128(even));
    add(1, _mm256_castpd256_pd128(odd));
    add(2, _mm256_extractf128_pd(even, 1));
    add(3, _mm256_extractf128_pd(odd, 1));
#else
    alignas(pack_alignment) std::array<double, pack_width> xs, ys;
    x.store_aligned(xs.data());
    y.store_aligned(ys.data());
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        pair_at(values, index[lane])[0] += xs[lane];
        pair_at(values, index[lane])[1] += ys[lane];
    }
#endif
}

}  // namespace gneiss
