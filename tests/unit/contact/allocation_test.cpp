// Once its arrays have grown, a search allocates nothing: a program of its own, since it counts every allocation of the
// process.

#include <gtest/gtest.h>

#include "support/counted_allocations.hpp"
#include "unit/contact/contact_testing.hpp"

namespace gneiss {
namespace {

TEST(ContactAllocation, SecondSearch_AllocatesNothing) {
    const test::Soup soup = test::bed(2000, 3);
    CellSearch search;
    const std::size_t before_first = n_allocations;
    search.search(soup.surroundings(), 0.1);
    EXPECT_GT(n_allocations, before_first);  // the count does count
    const std::size_t before = n_allocations;
    search.search(soup.surroundings(), 0.1);
    EXPECT_EQ(n_allocations, before);
}

}  // namespace
}  // namespace gneiss
