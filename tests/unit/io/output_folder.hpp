#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace gneiss::test {

/// A test with an empty folder of its own, removed afterwards.
class OutputFolder : public ::testing::Test {
protected:
    OutputFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "gneiss_output_XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
        folder = pattern;
    }
    ~OutputFolder() override { std::filesystem::remove_all(folder); }

    static std::string contents(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    static void put(const std::filesystem::path& path, const std::string& text) {
        std::ofstream(path, std::ios::binary) << text;
    }
    /// Makes every write of `path` meet a full disk: the part that is written first is the device that is always full.
    static void fill_disk(const std::filesystem::path& path) {
        std::filesystem::create_symlink("/dev/full", path.string() + ".part");
    }
    std::size_t n_files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
    }

    std::filesystem::path folder;
};

/// The message of the exception of type E that `action` throws; empty if it throws none.
template <class E, class F>
std::string message_of(F&& action) {
    try {
        action();
    } catch (const E& error) {
        return error.what();
    }
    return {};
}

}  // namespace gneiss::test
