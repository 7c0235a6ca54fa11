#pragma once
// IDA of SUNDIALS: BDF of variable order and step for systems in residual form  [Hindmarsh et al., ACM TOMS 31 (2005)
// 363].
//
// The residual is r = y' - F(t, y). Prescribed motion is eliminated, so that no algebraic equation is left and the
// index is 0: consistent values at the start are y' = F(t, y) themselves.

#include "integrators/sundials_ode.hpp"

namespace gneiss {

class Ida final : public SundialsOde {
public:
    struct Options : SundialsOde::Options {
        int max_order = 0;  ///< 1 to 5; 0: the largest

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };
    explicit Ida(const Options& options);

    std::string name() const override { return "ida"; }

private:
    void create(double t) override;
    void destroy() override { memory_.reset(); }
    void restart(double t) override;
    int step(double dt, double t_stop, double& t) override;
    int dense(double t, N_Vector at) override;
    double last_step() override;
    std::size_t failed_trials() override;
    std::string flag_name(int flag) override;
    /// y' = F(t, y).
    void find_rates(double t);

    Options options_;
    OwnedVector rates_;
    struct Deleter {
        void operator()(void* memory) const;
    };
    std::unique_ptr<void, Deleter> memory_;
};

}  // namespace gneiss
