#include <string.h>
#include <talus/nav_audit.h>
const char *tl_nav_cause_name(tl_nav_cause c)
{
    (void)c;
    return "?";
}
tl_result tl_nav_why(const tl_nav_def *def, const tl_nav_input *input, const tl_navmesh *navmesh, tl_vec3 point,
                     tl_nav_why_answer *answer_out, tl_report *report_out)
{
    (void)def;
    (void)input;
    (void)navmesh;
    (void)point;
    (void)report_out;
    memset(answer_out, 0, sizeof *answer_out);
    return TL_OK;
}
