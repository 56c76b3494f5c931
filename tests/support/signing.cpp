#include "tests/support/signing.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

namespace vesselbench::test {

bool can_sign() {
    const bool found = run_program("ssh-keygen", {"-?"}).exit_code != 127;
    if (!found) skip("no ssh-keygen");
    return found;
}

std::string new_signing_key() {
    const std::string key = temporary_folder() + "/key";
    const ProgramRun made = run_program("ssh-keygen", {"-q", "-t", "ed25519", "-N", "", "-f", key});
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    return key;
}

std::string sign(const std::string& file, const std::string& key, const std::string& name_space) {
    std::filesystem::remove(file + ".sig");  // which ssh-keygen would not replace
    const ProgramRun made =
        run_program("ssh-keygen", {"-q", "-Y", "sign", "-f", key, "-n", name_space, file});
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    return file + ".sig";
}

std::string allowed_line(const std::string& principal, const std::string& key,
                         const std::string& options) {
    return principal + " " + options + (options.empty() ? "" : " ") + file_content(key + ".pub");
}

std::string allowed_signers(const std::string& lines) {
    const std::string file = temporary_folder() + "/allowed_signers";
    write_file(file, lines);
    return file;
}

}  // namespace vesselbench::test
