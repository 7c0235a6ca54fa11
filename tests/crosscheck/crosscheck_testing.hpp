#pragma once
// Decks as text, their solution by deal.II.

#include <gtest/gtest.h>

#include <string>

#include "crosscheck/case.hpp"
#include "crosscheck/cholesky.hpp"
#include "io/deck/deck.hpp"

namespace gneiss::crosscheck::test {

struct Solved {
    ElasticCase what;
    Solution solution;
};

inline Solved solve_deck(const std::string& deck, Element element, int refine = 0) {
    Solved solved{elastic_case(parse_deck(deck, "deck"), element, refine), {}};
    solved.solution = solve(solved.what.problem, cholesky());
    return solved;
}

constexpr Element every_element[] = {Element::p1, Element::p2, Element::taylor_hood};

/// Anisotropic, nearly isotropic in nothing, axes along x and y.
inline const std::string rock =
    "material = [{ density = 1000.0, constants = { M_v = 0.4e9, M_alpha = 0.8e9, M_beta = 1.6e9, M_psi = 0.9e9 } }]\n";

}  // namespace gneiss::crosscheck::test
