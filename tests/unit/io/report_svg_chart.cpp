// Charts and pages: what stands in their text.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "io/report/html_page.hpp"
#include "io/report/svg_chart.hpp"

namespace gneiss {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
    return n;
}

TEST(AxisTicks, Linear_AreRoundAndInside) {
    EXPECT_THAT(axis_ticks(0, 10, false), ElementsAre(0, 2, 4, 6, 8, 10));
    EXPECT_THAT(axis_ticks(-0.1, 0.25, false), ElementsAre(-0.1, 0, 0.1, 0.2));
}

TEST(AxisTicks, Logarithmic_AreDecades_OrPartsOfThem) {
    EXPECT_THAT(axis_ticks(1e-6, 1e-2, true),
                ElementsAre(testing::DoubleNear(1e-6, 1e-20), testing::DoubleNear(1e-5, 1e-19),
                            testing::DoubleNear(1e-4, 1e-18), testing::DoubleNear(1e-3, 1e-17),
                            testing::DoubleNear(1e-2, 1e-16)));
    EXPECT_THAT(axis_ticks(3, 30, true), ElementsAre(5, 10, 20));
}

TEST(SvgChart, Points_StandWhereAxesSay) {
    // the middle of a logarithmic axis from 1 to 100 is 10
    const ChartSeries series{"a < b", {1, 10, 100}, {1, 2, 3}};
    const std::string svg = svg_chart("title", {"x", true}, {"y"}, std::span(&series, 1));
    EXPECT_THAT(svg, AllOf(HasSubstr("a &lt; b"), Not(HasSubstr("a < b")), HasSubstr(">title<")));
    const double middle = 0.5 * (80 + 900 - 250);
    EXPECT_THAT(svg, HasSubstr("<circle cx=\"" + std::to_string(middle).substr(0, 6) + "\" cy=\"211.00\""));
    EXPECT_EQ(count(svg, "<circle"), 4u) << "three points, one in the legend";
}

TEST(SvgChart, WhatAnAxisCannotShow_BreaksTheLine) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ChartSeries series{"s", {1, 2, 3, 4}, {1e-3, 0, nan, 1e-2}};
    const std::string svg = svg_chart("", {"x"}, {"y", true}, std::span(&series, 1));
    EXPECT_EQ(count(svg, "<circle"), 3u);
    EXPECT_EQ(svg.find('L', svg.find("fill=\"none\" stroke=\"#444\"")), std::string::npos) << "no two points in a row";
    EXPECT_THAT(svg_chart("", {"x"}, {"y"}, {}), HasSubstr("nothing to show"));
}

TEST(HtmlPage, Texts_AreEscaped_FiguresAreNot) {
    HtmlPage page("A & B");
    page.heading("1 < 2");
    page.table(std::vector<std::string>{"h"}, std::vector<std::vector<std::string>>{{"<td>"}});
    page.figure("<svg></svg>", "\"caption\"");
    EXPECT_THAT(page.text(),
                AllOf(HasSubstr("<title>A &amp; B</title>"), HasSubstr("<h2>1 &lt; 2</h2>"),
                      HasSubstr("<td>&lt;td&gt;</td>"), HasSubstr("<svg></svg>"), HasSubstr("&quot;caption&quot;")));
}

}  // namespace
}  // namespace gneiss
