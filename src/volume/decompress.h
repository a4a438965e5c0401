// The two compressors of volume files.
#pragma once

#include <cstddef>
#include <string_view>

namespace brume {

// Decompress `from` into the `size` bytes at `to`; false where the data is damaged or does not fill them exactly.
bool decompress_zip(std::string_view from, void* to, std::size_t size);
bool decompress_blosc(std::string_view from, void* to, std::size_t size);

// The same for the first `size` bytes, a multiple of 4, of what may be more.
bool decompress_zip_begin(std::string_view from, void* to, std::size_t size);
bool decompress_blosc_begin(std::string_view from, void* to, std::size_t size);

}  // namespace brume
