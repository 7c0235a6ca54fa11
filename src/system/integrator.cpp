#include "system/integrator.hpp"

#include "base/errors.hpp"

namespace gneiss {

const std::vector<double>& remembered(const IntegratorMemory& memory, const std::string& integrator,
                                      const std::string& entry, std::size_t size) {
    const auto found = memory.find(entry);
    if (found == memory.end() || found->second.size() != size)
        throw InputError("checkpoint",
                         integrator + ": `" + entry + "` is missing or has not " + std::to_string(size) + " values");
    return found->second;
}

}  // namespace gneiss
