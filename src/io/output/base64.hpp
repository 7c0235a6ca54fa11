#pragma once
// Bytes as text, by RFC 4648 section 4: three bytes as four letters, filled up with '='.

#include <string>
#include <string_view>

namespace gneiss {

std::string base64(std::string_view bytes);

}  // namespace gneiss
