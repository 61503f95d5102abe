"""Axisymmetric finite elements of the tube wall and the stone.

The parts, from the bottom: `problem`, `profile`, `mesh`, `wall`, `contact` and `friction` hold the
description and the forms; `discretisation`, `inner_wall` and `layouts` the meshes and unknowns;
`contact_predictor`, `loading_path`, `fitted_contact` and `active_set` the steps of the seated
contact, which `seating` puts together; `sliding_state`, `sliding_workspace`, `sliding_forces` and
`sliding_contact` the contact under a fluid pressure; `postprocessing`, `balances`, `loaded_wall`,
`self_intersection` and `buckling` evaluate the results.
"""
