#pragma once
// The key `amplitude`, of whatever has a member of this name.

#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {

template <class T>
Key<T> amplitude_key(const Spec& spec) {
    const std::string default_text = fmt::format("\"{}\"", name_of(amplitudes, AmplitudeOptions{}.kind));
    return custom<T>("amplitude", "a string or a table", default_text, spec,
                     [](const Value& value, TableReader&, T& out) { return read_amplitude(value, out.amplitude); });
}

}  // namespace gneiss::deck
