#include "io/report/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/report/html_page.hpp"

namespace gneiss {
namespace {

// px
constexpr double width = 900, height = 440, left = 80, right = 250, top = 36, bottom = 54;
constexpr double legend_line = 17;

// Okabe and Ito's colours, told apart by colour-blind eyes too, then darker ones of them.
constexpr std::array<std::string_view, 10> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                   "#56b4e9", "#000000", "#7a4f00", "#5b2a86", "#777777"};

/// The same series after series: a shape of its own for each round of colours.
std::string marker(std::size_t series, double x, double y) {
    const std::string_view colour = colours[series % colours.size()];
    switch (series / colours.size() % 3) {
        case 0:
            return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" fill=\"{}\"/>", x, y, colour);
        case 1:
            return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"8\" height=\"8\" fill=\"{}\"/>", x - 4, y - 4,
                               colour);
        default:
            return fmt::format("<path d=\"M{:.2f} {:.2f}l5 8h-10z\" fill=\"{}\"/>", x, y - 5, colour);
    }
}

/// How lines of each round of colours are drawn.
std::string_view dashes(std::size_t series) {
    constexpr std::array<std::string_view, 3> kinds{"", " stroke-dasharray=\"6 3\"", " stroke-dasharray=\"2 3\""};
    return kinds[series / colours.size() % kinds.size()];
}

/// One axis: from values to pixels.
class Scale {
public:
    Scale(const ChartAxis& axis, double from, double to) : logarithmic_(axis.logarithmic), from_(from), to_(to) {}

    bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
    void take(double value) {
        if (!shows(value)) return;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    bool empty() const { return !(low_ <= high_); }
    /// Some room at both ends; a single value gets an axis too.
    void widen() {
        if (logarithmic_) {
            const double room = std::max(1.05, std::pow(high_ / low_, 0.04));
            low_ /= room;
            high_ *= room;
        } else {
            const double extent = high_ > low_ ? high_ - low_ : std::max(std::abs(high_), 1.0);
            low_ -= 0.03 * extent;
            high_ += 0.03 * extent;
        }
    }
    std::vector<double> ticks() const { return axis_ticks(low_, high_, logarithmic_); }
    double at(double value) const {
        const double part =
            logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
        return from_ + part * (to_ - from_);
    }

private:
    bool logarithmic_;
    double from_, to_;  // px
    double low_ = std::numeric_limits<double>::infinity(), high_ = -std::numeric_limits<double>::infinity();
};

std::string text_at(double x, double y, std::string_view anchor, std::string_view text, std::string_view more = {}) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       html_text(text));
}

std::string grid(const Scale& x, const Scale& y) {
    std::string svg;
    for (const double tick : x.ticks()) {
        const double at = x.at(tick);
        svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/>", at, top, height - bottom);
        svg += text_at(at, height - bottom + 18, "middle", fmt::format("{:g}", tick));
    }
    for (const double tick : y.ticks()) {
        const double at = y.at(tick);
        svg += fmt::format("<path d=\"M{} {:.1f}H{}\" stroke=\"#ddd\"/>", left, at, width - right);
        svg += text_at(left - 8, at + 4, "end", fmt::format("{:g}", tick));
    }
    return svg + fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\"/>\n",
                             left, top, width - left - right, height - top - bottom);
}

std::string line_of(const ChartSeries& one, std::size_t number, const Scale& x, const Scale& y) {
    std::string path, markers;
    bool drawing = false;
    for (std::size_t i = 0; i < one.x.size(); ++i) {
        if (!x.shows(one.x[i]) || !y.shows(one.y[i])) {
            drawing = false;
            continue;
        }
        path += fmt::format("{}{:.2f} {:.2f}", drawing ? 'L' : 'M', x.at(one.x[i]), y.at(one.y[i]));
        drawing = true;
        if (one.markers) markers += marker(number, x.at(one.x[i]), y.at(one.y[i]));
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>{}\n", path,
                       colours[number % colours.size()], dashes(number), markers);
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, bool logarithmic) {
    std::vector<double> ticks;
    if (logarithmic) {
        const int first = static_cast<int>(std::floor(std::log10(low))),
                  last = static_cast<int>(std::ceil(std::log10(high)));
        const int every = std::max(1, (last - first) / 8);
        for (int decade = first; decade <= last; decade += every)
            for (const double factor : last - first <= 1   ? std::vector{1.0, 1.5, 2.0, 3.0, 5.0, 7.0}
                                       : last - first == 2 ? std::vector{1.0, 2.0, 5.0}
                                                           : std::vector{1.0})
                ticks.push_back(factor * std::pow(10.0, decade));
    } else {
        constexpr double wanted = 6;
        const double rough = (high - low) / wanted, decade = std::pow(10.0, std::floor(std::log10(rough)));
        double step = 10 * decade;
        for (const double factor : {5.0, 2.0, 1.0})
            if (factor * decade >= rough) step = factor * decade;
        for (double k = std::ceil(low / step); k * step <= high; ++k) ticks.push_back(k == 0 ? 0.0 : k * step);
    }
    std::erase_if(ticks, [&](double tick) { return tick < low || tick > high; });
    return ticks;
}

std::string svg_chart(const std::string& title, const ChartAxis& x, const ChartAxis& y,
                      std::span<const ChartSeries> series) {
    Scale across(x, left, width - right), up(y, height - bottom, top);
    for (const ChartSeries& one : series)
        for (std::size_t i = 0; i < one.x.size(); ++i)
            if (across.shows(one.x[i]) && up.shows(one.y[i])) {
                across.take(one.x[i]);
                up.take(one.y[i]);
            }
    const double full = std::max(height, top + legend_line * static_cast<double>(series.size() + 1));
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"system-ui, sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
        "fill=\"white\"/>\n",
        width, full);
    const double middle = 0.5 * (left + width - right);
    svg += text_at(middle, 20, "middle", title, " font-size=\"14\" font-weight=\"bold\"");
    if (across.empty()) return svg + text_at(middle, height / 2, "middle", "nothing to show") + "</svg>\n";
    across.widen();
    up.widen();
    svg += grid(across, up);
    for (std::size_t i = 0; i < series.size(); ++i) svg += line_of(series[i], i, across, up);
    svg += text_at(middle, height - 14, "middle", x.label);
    svg += text_at(0, 0, "middle", y.label,
                   fmt::format(" transform=\"translate(18 {:.1f}) rotate(-90)\"", 0.5 * (top + height - bottom)));
    for (std::size_t i = 0; i < series.size(); ++i) {
        const double at = top + legend_line * (static_cast<double>(i) + 0.5);
        svg += fmt::format("<path d=\"M{0} {1:.1f}h22\" stroke=\"{2}\" stroke-width=\"1.5\"{3}/>", width - right + 14,
                           at, colours[i % colours.size()], dashes(i));
        if (series[i].markers) svg += marker(i, width - right + 25, at);
        svg += text_at(width - right + 42, at + 4, "start", series[i].name);
    }
    return svg + "</svg>\n";
}

}  // namespace gneiss
