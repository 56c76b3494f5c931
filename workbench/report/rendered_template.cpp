#include "workbench/report/rendered_template.h"

#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/printable.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;
namespace mustache = kainjow::mustache;

mustache::data template_data(const Json& json) {
    if (json.is_string()) return printable(json.get<std::string>());
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_primitive()) return json.is_null() ? std::string() : json.dump();
    mustache::data data(json.is_array() ? mustache::data::type::list
                                        : mustache::data::type::object);
    for (const auto& [key, value] : json.items()) {
        if (json.is_array())
            data << template_data(value);
        else
            data[key] = template_data(value);
    }
    return data;
}

}  // namespace

std::string rendered_template(const std::string& text, const Json& document) {
    mustache::mustache html(text);
    return html.render(template_data(document));
}

}  // namespace vesselbench
