#pragma once
// A chart as the text of an <svg> element.

#include <span>
#include <string>
#include <vector>

namespace gneiss {

struct ChartSeries {
    std::string name;
    std::vector<double> x, y;  ///< as many of each; what an axis cannot show (not finite, or <= 0 on a logarithmic one)
                               ///< is left out, and breaks the line
    bool markers = true;
};

struct ChartAxis {
    std::string label;
    bool logarithmic = false;
};

/// @param x, y  the axes reach as far as the series do. With nothing to show the chart says so
std::string svg_chart(const std::string& title, const ChartAxis& x, const ChartAxis& y,
                      std::span<const ChartSeries> series);

/// Where an axis from low to high has ticks: decades (and 2 and 5 of each where there are few) or round steps.
std::vector<double> axis_ticks(double low, double high, bool logarithmic);

}  // namespace gneiss
