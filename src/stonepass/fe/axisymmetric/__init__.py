"""Axisymmetric finite elements of the tube wall and the stone.

Modules from the bottom layer to the top layer:

* `problem`, `profile`, `mesh`, `wall`, `contact`, `friction`: description of a problem, and forms;
* `discretisation`, `inner_wall`, `layouts`: meshes and unknown fields;
* `contact_predictor`, `loading_path`, `fitted_contact`, `active_set`: the solves of the seated
  contact, which `seating` combines;
* `sliding_state`, `sliding_workspace`, `sliding_forces`, `sliding_contact`: the contact under a
  fluid pressure;
* `postprocessing`, `balances`, `loaded_wall`, `self_intersection`, `buckling`: evaluation of the
  solutions, and checks.

Terms: a *station* is a reference coordinate Z of the inner wall. A *column* of elements spans the
wall from the inner to the outer surface, a *row* extends along the tube. The *half* is the part
Z ≥ 0 of a tube that is symmetric about the plane Z = 0; a stone without mirror symmetry needs the
*whole* tube.
"""
