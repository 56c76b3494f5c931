#include "meshing/stamp/refusal.h"

#include <utility>

namespace vesselbench {

void refuse(const char* code, const char* operation, const Vec3& place,
            std::map<std::string, double> figures, std::vector<Remedy> remedies) {
    throw DiagnosedFailure({.code = code,
                            .operation = operation,
                            .place = place,
                            .figures = std::move(figures),
                            .remedies = std::move(remedies)});
}

void refuse_parting(const Vec3& place) {
    refuse("contact-not-parted", "separate", place, {},
           {{.arguments = {{"at", ""}}}, {.operation = "stamp"}});
}

}  // namespace vesselbench
