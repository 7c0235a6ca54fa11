#include "model/eigenvalue_bound.hpp"

namespace gneiss {

template <int n>
Pack largest_eigenvalue_bound(std::array<Pack, n * n>& a, int squarings) {
    // A is kept at Frobenius norm 1; log of what was taken out
    const auto norm = [&] {
        Pack sum(0.0);
        for (const Pack& x : a) sum = xsimd::fma(x, x, sum);
        return xsimd::sqrt(sum);
    };
    Pack log_scale(0.0);
    double power = 1;
    for (int k = 0; k < squarings; ++k) {
        const Pack size = norm();
        const Pack safe = xsimd::max(size, Pack(1e-300));
        log_scale += xsimd::log(safe) * Pack(1 / power);
        const Pack scale = Pack(1.0) / safe;
        for (Pack& x : a) x *= scale;
        std::array<Pack, n * n> square;
        for (int i = 0; i < n; ++i) {
            for (int j = i; j < n; ++j) {
                Pack sum(0.0);
                for (int l = 0; l < n; ++l) sum = xsimd::fma(a[i * n + l], a[j * n + l], sum);
                square[i * n + j] = square[j * n + i] = sum;
            }
        }
        a = square;
        power *= 2;
    }
    Pack trace(0.0);
    for (int i = 0; i < n; ++i) trace += a[i * n + i];
    return xsimd::exp(log_scale + xsimd::log(xsimd::max(trace, Pack(1e-300))) * Pack(1 / power));
}

template Pack largest_eigenvalue_bound<6>(std::array<Pack, 36>&, int);
template Pack largest_eigenvalue_bound<12>(std::array<Pack, 144>&, int);

}  // namespace gneiss
