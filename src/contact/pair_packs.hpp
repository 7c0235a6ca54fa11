#pragma once
// Pairs of a contactor point and a target triangle, side by side in packs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "base/pack.hpp"
#include "contact/cell_search.hpp"
#include "contact/contact_point.hpp"

namespace gneiss {

using AlignedDoubles = std::vector<double, xsimd::aligned_allocator<double, pack_alignment>>;

/// 1 in the lanes whose bits are set, 0 in the others.
inline Pack ones_where(std::uint64_t bits) {
#if defined(__AVX512F__)
    return Pack(_mm512_maskz_mov_pd(static_cast<__mmask8>(bits), _mm512_set1_pd(1.0)));
#else
    alignas(pack_alignment) std::array<double, pack_width> ones;
    for (std::size_t lane = 0; lane < pack_width; ++lane) ones[lane] = static_cast<double>(bits >> lane & 1);
    return Pack::load_aligned(ones.data());
#endif
}

/// What a search has found, laid out for `contains`. Lanes behind the last pair repeat it.
struct CandidatePacks {
    std::vector<ContactCandidate> pairs;
    std::vector<PairNumber> points;    ///< shape (packs, lanes)
    std::vector<PairNumber> nodes;     ///< of the triangles, shape (packs, 3, lanes)
    std::vector<std::uint8_t> rising;  ///< of `contains`, a bit per lane, shape (packs, 3)

    std::size_t n_packs() const { return points.size() / pack_width; }

    void assign(std::span<const ContactCandidate> found, std::span<const std::array<std::int32_t, 3>> triangles) {
        static_assert(pack_width <= 8);
        pairs.assign(found.begin(), found.end());
        const std::size_t n = padded(pairs.size());
        points.resize(n);
        nodes.resize(3 * n);
        rising.assign(3 * n_packs(), 0);
        for (std::size_t i = 0; i < n; ++i) {
            const ContactCandidate& pair = pairs[i < pairs.size() ? i : pairs.size() - 1];
            const auto& triangle = triangles[static_cast<std::size_t>(pair.triangle)];
            const std::size_t pack = i / pack_width, lane = i % pack_width;
            points[i] = {pair.point};
            for (std::size_t k = 0; k < 3; ++k) {
                nodes[(3 * pack + k) * pack_width + lane] = {triangle[k]};
                const int bit = triangle[(k + 1) % 3] < triangle[(k + 2) % 3] ? 1 : 0;
                rising[3 * pack + k] = static_cast<std::uint8_t>(rising[3 * pack + k] | bit << lane);
            }
        }
    }
};

/// What contact has to know of a target beside its shapes, in pairs of numbers that packs are gathered from.
struct TargetConstants {
    static constexpr std::size_t n_pairs = 3;
    std::array<double, 3> nodal;  ///< of TrianglePotential, m
    double bubble, reach;         ///< of TrianglePotential, m
    double layer;                 ///< compliance of the body, m/Pa
};

/// The same of a contactor point.
struct PointConstants {
    static constexpr std::size_t n_pairs = 2;
    double weight_b;
    double area;   ///< thickness times tributary length, m2
    double layer;  ///< compliance of the body, m/Pa
    double unused = 0;
};

/// A pack of pairs in touch.
struct LoadedPairs {
    Vec2<Pack> a, b;              ///< ends of the contactor's edge, m
    std::array<Vec2<Pack>, 3> x;  ///< current nodes of the target, m
    Pack weight_b;
    ContactTarget<Pack> target;
    ContactLaw<Pack> law;
    ContactHistory<Pack> old;

    /// @param a, b, x  plain, or with derivatives
    template <Tangential tangential = Tangential::held, class T>
    auto respond(const Vec2<T>& from, const Vec2<T>& to, const std::array<Vec2<T>, 3>& at) const {
        const Pack weight_a = Pack(1.0) - weight_b;
        const Vec2<T> point{weight_a * from.x + weight_b * to.x, weight_a * from.y + weight_b * to.y};
        return contact_response<tangential>(point, at, target, law, old);
    }
};

}  // namespace gneiss
