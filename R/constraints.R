# The constraints, one record each. A new one needs a line in the list below and files of its own;
# the verbs use the record and name no constraint.
#
# A record:
#   id            name of the constraint, as models() shows it
#   scene_class   class of its scenes
#   form          of its scenes, see R/form.R
#   fault(scene)  NULL, or the part that does not fit the others, of a scene with that form
#   title(run)    title of the picture, and of prints: what the user described
#   models        records of models, see R/model.R
#   effects, effects_of(scene)   what a scene may contain: words by name, and the names of those
#                 of a scene; from the C core
#   columns       columns of a result
#   keys          those that hold the state: the class is kept with them
#   more_columns(columns, scene, time_s)   NULL, or completes the columns of a run
#   more_names(scene)            NULL, or the names of those that only some scenes have
#   event_rows    NULL, or TRUE: a trajectory has the column `event`, and a run that is asked with
#                 event_rows = TRUE also gives event_rows, list(columns, ledger): the rows at the
#                 times of its events
#   of_scene(scene, record)   NULL, or the record for one scene: where columns, keys, measures or
#                 panels are those that its user named; it must take damaged scenes
#   named         of such a record: the names of columns and measures by those in the core's table
#   remedies      NULL, or by kind what to do about a run that failed, see R/run-report.R
#   quick         TRUE where neither more_columns nor ends has a part in the scenes
#   ends(scene, columns)   NULL, or the text that says from when on the model is not valid; columns:
#                 those of a motion, or NULL
#   index, rows_per_time(scene)   a second index of the rows (rotor), and how many there are for
#                 each time
#   measures      named list of measure(), to which errors and accuracies refer
#   slopes(columns, scene)       NULL, or list: by column, what has the sign of its slope in time
#   time_scales(scene, sizes, model)   NULL, or list(breaks_s, fades_s, swing_rad_per_s, drifts):
#                 times of kinks, the shortest time in which a transient fades (Inf: none), the
#                 fastest swing, whether the motion goes on beyond its swings
#   periods(scene, call)         NULL, or the columns of period_of(), recycled to its rows
#   call_laws(scene, call)       NULL, or NULL where a scene has no R functions, else a function
#                 that calls each once with the state of the start: for what a run costs
#   more_events(x, run, call)    NULL, or events that motion_events() looks for: list(time_s, event)
#   summary(x, run)              columns that summary() puts first
#   balances(x, run, call)       list of balance(), see R/audit.R
#   conserved(scene)             NULL, or list of keeps(), see R/conserved.R: what is conserved and
#                 why, by the names and points of the balances
#   augment(x, run, edges, call) columns of augment(), a value for each time of `edges` (power_w:
#                 for each row); NULL where the motion could not be computed again
#   panels        list of panel(): the picture of a motion
#   makers        NULL, or by the class of their scenes: what further constructors change in the
#                 record; the texts of theirs are among these parts
#   moments(scene)               NULL: scene$moment_of_inertia_kg_m2; or those of its bodies
#   texts         forms by constructor: how a scene is written and read, see R/scene-text.R
#   drawing(scene)               NULL, or the drawing of a scene, see R/draw.R
#   solid(scene), frames(scene, rows)   NULL, or what animate_motion() shows, see R/animate.R
constraint_list <- function() {
  list(
    axle_constraint(), rotors_constraint(), clutch_constraint(), drive_constraint(),
    incline_constraint(), free_constraint(), pivot_constraint(), hoop_constraint(),
    chain_constraint(), equations_constraint()
  )
}

.onLoad <- function(libname, pkgname) {
  listed <- constraint_list()
  for (constraint in listed) join_constraint(constraint)
  joined$classes <- vapply(listed, function(constraint) constraint$scene_class, "")
  set_default_verbs()
  register_plots()
  # Its methods print our tables. Commands of the shell print lines of their own.
  if (!isFALSE(getOption("rotdyn.tables"))) loadNamespace("tibble")
}

# The effects and the promises of the models are those of the core (src/core/scene/choice.c).
join_constraint <- function(constraint) {
  id <- constraint$id
  constraint$models <- lapply(constraint$models, core_record)
  constraint$effects <- core_effect_words(id)
  constraint$effects_of <- function(scene) core_effects(id, scene)
  names(constraint$models) <- vapply(constraint$models, function(m) m$id, "")
  makers <- constraint$makers
  assign(constraint$scene_class, constraint, envir = registry)
  for (class in names(makers)) {
    one <- constraint
    one[names(makers[[class]])] <- makers[[class]]
    assign(class, one, envir = registry)
  }
}
