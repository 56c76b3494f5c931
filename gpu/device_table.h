#pragma once

#include "gpu/objects.h"

namespace vesselbench {

/// A table that shaders only read. Drivers limit the buffers of a shader, some to 128 MiB, but not
/// textures that read a buffer: a larger table has such a view, and its shaders are compiled with
/// WIDE defined.
struct DeviceTable {
    Buffer buffer;
    Texture view = {};  ///< of unsigned words; none: the buffer itself is bound

    [[nodiscard]] bool wide() const { return view.id() != 0; }
};

/// Rows of elements on the device: row i spans offsets[i] to offsets[i + 1].
struct DeviceRows {
    Buffer offsets;  ///< uint, one more than rows
    DeviceTable values;
};

}  // namespace vesselbench
