/* SPDX-License-Identifier: Apache-2.0 */
#include "ivisnav.h"
#include "oltae.h"

/* for tb/c/library.py: what its structures must measure, in its order */
extern const size_t relnav_sizes[];
const size_t relnav_sizes[] = {
    sizeof(relnav_port), sizeof(relnav_core), sizeof(relnav_reals), sizeof(relnav_range), sizeof(oltae),
    sizeof(oltae_frame), sizeof(oltae_scale), sizeof(oltae_raw), sizeof(oltae_result), sizeof(ivisnav),
    sizeof(ivisnav_frame), sizeof(ivisnav_scale), sizeof(ivisnav_raw), sizeof(ivisnav_result),
};
