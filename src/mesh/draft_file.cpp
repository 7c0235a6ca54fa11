#include "mesh/draft_file.hpp"

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace gneiss {
namespace {

/// Visits the members of a draft in one order, for writing and for reading.
template <class Draft, class Archive>
void for_each_member(Draft& draft, Archive&& archive) {
    archive(draft.where);
    archive(draft.nodes);
    archive(draft.node_labels);
    archive(draft.report_unused_nodes);
    archive(draft.elements);
    archive(draft.element_labels);
    archive(draft.region);
    archive(draft.region_names);
    archive(draft.element_data);
    archive(draft.lines);
    archive(draft.points);
    archive(draft.warnings);
}

class Writer {
public:
    explicit Writer(std::ofstream& stream) : stream_(stream) {}
    template <class T>
    void operator()(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        stream_.write(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    void operator()(const std::string& text) { array(text.data(), text.size()); }
    template <class T>
    void operator()(const std::vector<T>& values) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            array(values.data(), values.size());
        } else {
            (*this)(values.size());
            for (const T& value : values) (*this)(value);
        }
    }
    template <class K, class V>
    void operator()(const std::map<K, V>& map) {
        (*this)(map.size());
        for (const auto& [key, value] : map) {
            (*this)(key);
            (*this)(value);
        }
    }
    void operator()(const Problem& problem) {
        (*this)(problem.where);
        (*this)(problem.message);
    }

private:
    template <class T>
    void array(const T* first, std::size_t n) {
        (*this)(n);
        stream_.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(n * sizeof(T)));
    }
    std::ofstream& stream_;
};

class DraftReader {
public:
    explicit DraftReader(std::ifstream& stream) : stream_(stream) {}
    template <class T>
    void operator()(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        stream_.read(reinterpret_cast<char*>(&value), sizeof(T));
    }
    void operator()(std::string& text) { array(text); }
    template <class T>
    void operator()(std::vector<T>& values) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            array(values);
        } else {
            values.resize(size());
            for (T& value : values) (*this)(value);
        }
    }
    template <class K, class V>
    void operator()(std::map<K, V>& map) {
        const std::size_t n = size();
        for (std::size_t i = 0; i < n; ++i) {
            K key;
            (*this)(key);
            (*this)(map[key]);
        }
    }
    void operator()(Problem& problem) {
        (*this)(problem.where);
        (*this)(problem.message);
    }

private:
    std::size_t size() {
        std::size_t n = 0;
        (*this)(n);
        return stream_ ? n : 0;
    }
    template <class Container>
    void array(Container& values) {
        values.resize(size());
        stream_.read(reinterpret_cast<char*>(values.data()),
                     static_cast<std::streamsize>(values.size() * sizeof(values[0])));
    }
    std::ifstream& stream_;
};

}  // namespace

void write_draft(const std::filesystem::path& file, const DraftOrProblems& result) {
    std::ofstream stream(file, std::ios::binary);
    Writer writer(stream);
    const bool is_draft = std::holds_alternative<MeshDraft>(result);
    writer(is_draft);
    if (is_draft)
        for_each_member(std::get<MeshDraft>(result), writer);
    else
        writer(std::get<std::vector<Problem>>(result));
    if (!stream.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

DraftOrProblems read_draft(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    DraftReader reader(stream);
    bool is_draft = false;
    reader(is_draft);
    DraftOrProblems result;
    if (is_draft)
        for_each_member(result.emplace<MeshDraft>(), reader);
    else
        reader(result.emplace<std::vector<Problem>>());
    if (!stream) throw std::runtime_error(file.string() + " is not whole");
    return result;
}

}  // namespace gneiss
