#pragma once
// CVODE of SUNDIALS: multistep methods of variable order and step, BDF for stiff systems, Adams for others  [Hindmarsh
// et al., ACM TOMS 31 (2005) 363].

#include "base/scheme_defaults.hpp"
#include "integrators/sundials_ode.hpp"

namespace gneiss {

class Cvode final : public SundialsOde {
public:
    enum class Method { bdf, adams };
    enum class Iteration { newton, functional };
    struct Options : SundialsOde::Options {
        Method method = Method::bdf;
        int max_order = 0;  ///< BDF 1 to 5, Adams 1 to 12; 0: the largest
        Iteration iteration = Iteration::newton;
        /// Lowers the order of BDF where SUNDIALS' detection finds orders 3 to 5 unstable. Of undamped vibration it
        /// finds too little too late, and its steps cost more than a smaller tolerance does  [decision 027].
        bool stability_detection = scheme_defaults::stability_detection;

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };
    explicit Cvode(const Options& options);

    std::string name() const override { return "cvode"; }

private:
    void create(double t) override;
    void destroy() override { memory_.reset(); }
    void restart(double t) override;
    int step(double dt, double t_stop, double& t) override;
    int dense(double t, N_Vector at) override;
    double last_step() override;
    std::size_t failed_trials() override;
    std::string flag_name(int flag) override;

    Options options_;
    struct Deleter {
        void operator()(void* memory) const;
    };
    OwnedNonlinearSolver nonlinear_;
    std::unique_ptr<void, Deleter> memory_;
};

}  // namespace gneiss
