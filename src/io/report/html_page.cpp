#include "io/report/html_page.hpp"

#include <fmt/format.h>

namespace gneiss {
namespace {

constexpr std::string_view style = R"(
body { font: 15px/1.45 system-ui, sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222; }
h1 { font-size: 1.5em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; font-size: 0.85em; display: block; overflow-x: auto; }
th, td { padding: 0.25em 0.6em; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; }
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2), td:last-child, th:last-child { text-align: left; }
td:last-child { white-space: normal; min-width: 12em; }
figure { margin: 1em 0; } figcaption { color: #555; font-size: 0.9em; }
svg { max-width: 100%; height: auto; }
)";

}  // namespace

std::string html_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

HtmlPage::HtmlPage(std::string title) : title_(std::move(title)) {}

void HtmlPage::heading(std::string_view text) { body_ += fmt::format("<h2>{}</h2>\n", html_text(text)); }

void HtmlPage::paragraph(std::string_view text) { body_ += fmt::format("<p>{}</p>\n", html_text(text)); }

void HtmlPage::table(std::span<const std::string> header, std::span<const std::vector<std::string>> rows) {
    const auto row = [this](std::span<const std::string> cells, const char* tag) {
        body_ += "<tr>";
        for (const std::string& cell : cells) body_ += fmt::format("<{0}>{1}</{0}>", tag, html_text(cell));
        body_ += "</tr>\n";
    };
    body_ += "<table>\n";
    row(header, "th");
    for (const auto& cells : rows) row(cells, "td");
    body_ += "</table>\n";
}

void HtmlPage::figure(std::string_view svg, std::string_view caption) {
    body_ += fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", svg, html_text(caption));
}

std::string HtmlPage::text() const {
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta "
        "charset=\"utf-8\">\n<title>{0}</title>\n<style>{1}</style>\n"
        "</head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</html>\n",
        html_text(title_), style, body_);
}

}  // namespace gneiss
