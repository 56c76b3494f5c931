#include "workbench/session/login_name.h"

#include <pwd.h>
#include <unistd.h>

#include "geometry/kernel/printable.h"

namespace vesselbench {

std::string login_name() {
    const passwd* user = getpwuid(geteuid());
    return user != nullptr ? printable(user->pw_name) : "unknown";
}

}  // namespace vesselbench
