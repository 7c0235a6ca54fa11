#include "mesh/abaqus_keywords.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

#include "base/errors.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blanks = " \t\r";

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

/// Entries between commas; the empty one behind a comma at the end is none.
std::vector<std::string> entries_of(std::string_view line) {
    std::vector<std::string> entries;
    while (true) {
        const std::size_t comma = line.find(',');
        const bool last = comma == std::string_view::npos;
        std::string entry = trimmed(line.substr(0, comma));
        if (!last || !entry.empty()) entries.push_back(std::move(entry));
        if (last) return entries;
        line.remove_prefix(comma + 1);
    }
}

bool ends_in_comma(const std::string& line) { return !line.empty() && line.back() == ','; }

std::string unquoted(std::string text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
    return text;
}

AbaqusKeyword keyword_of(const std::string& line, std::string where) {
    AbaqusKeyword keyword;
    keyword.where = std::move(where);
    const std::vector<std::string> words = entries_of(std::string_view(line).substr(1));
    for (const char c : words.empty() ? std::string() : capitals(words[0]))
        if (c != ' ' || (!keyword.name.empty() && keyword.name.back() != ' ')) keyword.name += c;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        std::string value = equals == std::string::npos ? "" : unquoted(trimmed(words[i].substr(equals + 1)));
        keyword.parameters[capitals(trimmed(words[i].substr(0, equals)))] = std::move(value);
    }
    return keyword;
}

class KeywordReader {
public:
    std::vector<AbaqusKeyword> read(const fs::path& file) {
        add(file, 0, "");
        return std::move(keywords_);
    }

private:
    /// @param from  file and line that name it; empty: none does
    static std::ifstream opened(const fs::path& file, const std::string& from) {
        std::ifstream stream(file);
        if (!stream && from.empty()) throw InputError(file.string(), "cannot be opened for reading");
        if (!stream) throw InputError(from, fmt::format("names {}, which cannot be opened for reading", file.string()));
        return stream;
    }

    /// @return false where the rest is no mesh any more
    bool add(const fs::path& file, int depth, const std::string& from) {
        constexpr int deepest = 20;
        if (depth > deepest) throw InputError(file.string(), "files include each other");
        std::ifstream stream = opened(file, from);
        const auto name = std::make_shared<const std::string>(file.string());
        std::string line, whole;
        for (int number = 1; std::getline(stream, line); ++number) {
            line = trimmed(line);
            if (line.empty() || line.starts_with("**")) continue;
            if (line[0] == '*') {
                const std::string where = fmt::format("{}:{}", file.string(), number);
                while (ends_in_comma(line) && std::getline(stream, whole)) {  // parameters go on below
                    line += trimmed(whole);
                    ++number;
                }
                AbaqusKeyword keyword = keyword_of(line, where);
                if (keyword.name == "STEP") return false;
                if (keyword.name == "INCLUDE") {
                    if (!add(file.parent_path() / keyword.value("INPUT"), depth + 1, where)) return false;
                    continue;
                }
                const std::string input = keyword.value("INPUT");
                keywords_.push_back(std::move(keyword));
                if (!input.empty()) read_data(file.parent_path() / input, where);
                continue;
            }
            if (keywords_.empty())
                throw InputError(file.string(), "is no input file of Abaqus: it does not begin with a keyword");
            add_data(line, name, number);
        }
        return true;
    }

    /// Lines of data in a file of their own.
    void read_data(const fs::path& file, const std::string& from) {
        std::ifstream stream = opened(file, from);
        const auto name = std::make_shared<const std::string>(file.string());
        std::string line;
        for (int number = 1; std::getline(stream, line); ++number) {
            line = trimmed(line);
            if (!line.empty() && !line.starts_with("**")) add_data(line, name, number);
        }
    }

    void add_data(const std::string& line, const std::shared_ptr<const std::string>& file, int number) {
        keywords_.back().data.push_back({entries_of(line), ends_in_comma(line), file, number});
    }

    std::vector<AbaqusKeyword> keywords_;
};

}  // namespace

std::string AbaqusLine::where() const { return fmt::format("{}:{}", *file, number); }

std::string AbaqusKeyword::value(const std::string& parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
}

std::string capitals(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::vector<AbaqusKeyword> abaqus_keywords(const fs::path& file) { return KeywordReader().read(file); }

}  // namespace gneiss
