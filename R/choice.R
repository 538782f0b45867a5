# The choice of a model, which the C core makes (src/core/scene/choice.h), for constraints that it
# knows by name: "axle", "rotors", "clutch". `scene` is an R scene of that constraint, `law_s` the
# time in s of one call of its torque function (ignored where it has none). A prediction of time is
# in s.

# The models of the core, in the order of its lists: named columns model, constraint, error (the
# smallest promised), error_kind ("bound", "estimate"), on_trial (only a run tells the error), why
# (what makes a scene fit), takes (list: names of effects).
core_models <- function() .Call(ffi_choice_models)

# Words of the effects of a constraint, by name.
core_effect_words <- function(constraint) .Call(ffi_choice_effects, constraint, NULL)

# Names of the effects that act in a scene.
core_effects <- function(constraint, scene) .Call(ffi_choice_effects, constraint, scene)

# All models on a scene, cheapest first: named columns
#   model, error_kind   as above
#   applies   it takes the scene, or the scene without `dropped`, and promises the accuracy
#   error     promised relative error, with what dropping changes; on trial that of the run
#   cost_s    predicted time
#   chosen    TRUE for the first that applies
#   reason    why it is chosen, would do, or does not apply; or what was dropped
#   dropped   list: NULL, or list(effects, until_s, errors = c(theta, omega), error, each): bounds
#             on what leaving the effects out changes, up to until_s; error, and omega's share
#             effect by effect (each), relative to the size of the motion
core_candidates <- function(constraint, scene, time_s, accuracy, law_s = 1e-6) {
  .Call(ffi_choice_table, constraint, scene, time_s, accuracy, law_s)
}

# list(model, dropped, applies, reason): the models to run, cheapest first, all but the last on
# trial (and the last, where no other applies), and what each leaves out, as above; character() if
# none applies. With `model`, the id of one, that one: whether it applies, and the reason if not.
core_pick <- function(constraint, scene, time_s, accuracy, law_s = 1e-6, model = NULL) {
  .Call(ffi_choice_pick, constraint, scene, time_s, accuracy, law_s, model)
}
