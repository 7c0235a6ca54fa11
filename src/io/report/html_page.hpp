#pragma once
// One self-contained page of HTML.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

/// The same text, with what HTML takes for its own replaced.
std::string html_text(std::string_view text);

class HtmlPage {
public:
    explicit HtmlPage(std::string title);

    void heading(std::string_view text);
    void paragraph(std::string_view text);
    /// @param rows  texts, each row of the length of the header
    void table(std::span<const std::string> header, std::span<const std::vector<std::string>> rows);
    /// @param svg  an `<svg>` element, taken as it is
    void figure(std::string_view svg, std::string_view caption);

    /// The whole page.
    std::string text() const;

private:
    std::string title_, body_;
};

}  // namespace gneiss
