#include "tests/support/beginning.h"

#include <filesystem>

#include "tests/support/shapes.h"

namespace fs = std::filesystem;

namespace vesselbench::test {

KeptFolder::KeptFolder() : path_(temporary_folder() + "/begun") {
    fs::create_directory(path_);
}

void KeptFolder::keep() {
    kept_ = temporary_folder() + "/kept";
    fs::copy(path_, kept_, fs::copy_options::recursive);
}

void KeptFolder::restore() const {
    fs::remove_all(path_);
    fs::copy(kept_, path_, fs::copy_options::recursive);
}

}  // namespace vesselbench::test
