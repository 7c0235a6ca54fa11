#include "io/output/stop_request.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

namespace gneiss {
namespace {

void (*handler_of(int signal))(int) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    return action.sa_handler;
}

TEST(StopRequest, NoSignal_NothingRequested) {
    const StopRequest stop;
    EXPECT_FALSE(stop.requested());
    EXPECT_EQ(stop.exit_code(), 0);
}

TEST(StopRequest, Interrupt_RequestedWithCode130) {
    const StopRequest stop;
    std::raise(SIGINT);
    EXPECT_TRUE(stop.requested());
    EXPECT_EQ(stop.exit_code(), 130);
}

TEST(StopRequest, Terminate_RequestedWithCode143) {
    const StopRequest stop;
    std::raise(SIGTERM);
    EXPECT_TRUE(stop.requested());
    EXPECT_EQ(stop.exit_code(), 143);
}

TEST(StopRequest, TerminateTwiceThenInterrupt_FirstCounts) {
    const StopRequest stop;
    std::raise(SIGTERM);
    std::raise(SIGTERM);
    std::raise(SIGINT);
    EXPECT_EQ(stop.exit_code(), 143);
}

TEST(StopRequest, AnotherLife_BeginsWithoutRequest) {
    {
        const StopRequest stop;
        std::raise(SIGINT);
    }
    const StopRequest stop;
    EXPECT_FALSE(stop.requested());
    std::raise(SIGINT);
    EXPECT_TRUE(stop.requested());
}

TEST(StopRequest, EndOfLife_RestoresFormerHandlers) {
    const auto former = std::signal(SIGINT, [](int) {});
    const auto mine = handler_of(SIGINT);
    const auto terminate = handler_of(SIGTERM);
    {
        const StopRequest stop;
        EXPECT_NE(handler_of(SIGINT), mine);
        EXPECT_NE(handler_of(SIGTERM), terminate);
        std::raise(SIGINT);
    }
    EXPECT_EQ(handler_of(SIGINT), mine);
    EXPECT_EQ(handler_of(SIGTERM), terminate);
    std::signal(SIGINT, former);
}

TEST(StopRequest, IgnoredByTheParent_StaysIgnored) {
    const auto former = std::signal(SIGINT, SIG_IGN);
    {
        const StopRequest stop;
        std::raise(SIGINT);
        EXPECT_FALSE(stop.requested());
    }
    EXPECT_EQ(handler_of(SIGINT), SIG_IGN);
    std::signal(SIGINT, former);
}

TEST(StopRequest, Second_IsRefused) {
    const StopRequest stop;
    EXPECT_THROW(StopRequest(), std::logic_error);
    std::raise(SIGINT);
    EXPECT_TRUE(stop.requested());  // the first one still works
}

TEST(StopRequestDeathTest, SecondInterrupt_EndsTheProcess) {
    EXPECT_EXIT(
        {
            const StopRequest stop;
            std::raise(SIGINT);
            if (!stop.requested()) std::_Exit(1);
            std::raise(SIGINT);
            std::_Exit(2);
        },
        ::testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace gneiss
