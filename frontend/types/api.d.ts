// Generated from openapi.json by `python -m tests.server.typescript`. Do not edit.

export interface paths {
  "/api/comparisons": {
    post: operations["compare_with_measurement"];
  };
  "/api/curves": {
    post: operations["compute_curves"];
  };
  "/api/diagnoses": {
    post: operations["diagnose_model"];
  };
  "/api/effects": {
    get: operations["list_effects"];
  };
  "/api/experiments": {
    post: operations["describe_experiments"];
  };
  "/api/exports": {
    get: operations["list_formats"];
    post: operations["write_export"];
  };
  "/api/health": {
    get: operations["read_health"];
  };
  "/api/inverse": {
    post: operations["answer_question"];
  };
  "/api/kept": {
    get: operations["list_kept"];
  };
  "/api/kept/{kind}/{identity}": {
    delete: operations["delete_kept"];
    patch: operations["rename_kept"];
  };
  "/api/kept/{kind}/{identity}/restore": {
    post: operations["restore_kept"];
  };
  "/api/linearisations": {
    post: operations["linearise_drive"];
  };
  "/api/measurements": {
    put: operations["upload_measurement"];
  };
  "/api/measurements/preview": {
    post: operations["preview_measurement"];
  };
  "/api/measurements/{measurement_id}": {
    get: operations["read_measurement"];
  };
  "/api/mysteries": {
    get: operations["list_mysteries"];
  };
  "/api/mysteries/{mystery_id}/reveal": {
    post: operations["reveal_mystery"];
  };
  "/api/order-codes/{code}": {
    get: operations["read_order_code"];
  };
  "/api/presets/muscles": {
    post: operations["save_muscle"];
  };
  "/api/presets/muscles/fitted": {
    post: operations["keep_fitted_muscle"];
  };
  "/api/presets/{kind}": {
    get: operations["list_presets"];
  };
  "/api/presets/{kind}/{preset_id}": {
    get: operations["read_preset"];
  };
  "/api/projects": {
    get: operations["list_projects"];
    post: operations["create_project"];
  };
  "/api/projects/import": {
    post: operations["import_project"];
  };
  "/api/projects/{project_id}": {
    get: operations["open_project"];
    put: operations["save_project"];
    delete: operations["delete_project"];
    patch: operations["describe_project"];
  };
  "/api/projects/{project_id}/copies": {
    post: operations["copy_project"];
  };
  "/api/projects/{project_id}/file": {
    get: operations["export_project"];
  };
  "/api/projects/{project_id}/history": {
    get: operations["read_history"];
  };
  "/api/projects/{project_id}/restore": {
    post: operations["restore_project"];
  };
  "/api/reports": {
    post: operations["write_report"];
  };
  "/api/signatures": {
    post: operations["draw_signatures"];
  };
  "/api/simulations": {
    post: operations["simulate_drive"];
  };
  "/api/sizings": {
    post: operations["size_drives"];
  };
  "/api/sizings/reports": {
    post: operations["write_sizing_report"];
  };
  "/api/studies": {
    post: operations["run_study"];
  };
  "/api/studies/kept": {
    post: operations["count_kept_runs"];
  };
  "/api/studies/options": {
    post: operations["list_study_options"];
  };
  "/api/studies/parquet": {
    post: operations["write_parquet"];
  };
}

export interface components {
  schemas: {
    /** What the accuracy of the measurement took up instead of the model: an error of a clamp or a sensor. */
    Absorbed: {
      /** The channel. */
      channel: string;
      /** What it belongs to. */
      of: string;
      /** Estimated error of the reading, SI. */
      value: number;
      /** Its standard error, SI. */
      stderr: number;
      /** Stated or assumed standard deviation, SI. */
      accuracy: number;
      /** SI unit of value, stderr and accuracy. */
      unit: string;
      /** What it changes of the predicted channel, SI. */
      rms: number;
    };
    /** The start model as given. */
    Baseline: {
      /** Root mean square of the residual. */
      rmse: number;
      /** RMSE over the largest measured magnitude. */
      nrmse_percent: number | null;
      /** RMSE with whole groups left out of the fit. */
      holdout_rmse: number;
    };
    /** The start model with one more effect, all parameters refitted. */
    Candidate: {
      /** Its id. */
      effect: string;
      /** Its name. */
      title: string;
      /** Root mean square of the residual with it. */
      rmse: number;
      /** RMSE with whole groups left out of the fit. */
      holdout_rmse: number;
      /** By how much it lowers the error of the start model. */
      gain_percent: number;
      /** Change of the score of the search; negative is better. */
      score_change: number;
      /** Older name of score_change, for this version only. */
      delta_bic: number;
      /** Effect -> parameter -> value. */
      parameters: { [key: string]: components["schemas"]["FittedParameter"] };
      /** Candidates that these data cannot distinguish from it. */
      twins: string[];
      /** What speaks for and against it. */
      why: string;
      /** LaTeX. */
      equation: string;
      /** Constants of other effects that were fitted with it, as effect.parameter. */
      freed: string[];
      /** Experiment that separates it from its first twin. */
      next_measurement: string | null;
      /** The model with it. */
      model: components["schemas"]["ModelJson"];
      /** That it, or one of its twins in the best model, is missing; null while the search runs. */
      probability: number | null;
    };
    /** One used column of a measurement. */
    Channel: {
      /** Name of the channel. */
      name: string;
      /** Header of the file. */
      column: string;
      /** Unit in the file. */
      unit: string;
      /** SI unit of minimum, maximum and the columns. */
      si_unit: string;
      /** Smallest value, SI. */
      minimum: number | null;
      /** Largest value, SI. */
      maximum: number | null;
    };
    /** A channel to which a column can be mapped. */
    ChannelChoice: {
      /** Name of the channel. */
      name: string;
      /** Its SI unit. */
      si_unit: string;
      /** Usual units; others are accepted too. */
      units: string[];
    };
    /** Error of one of several predicted channels, SI. */
    ChannelError: {
      /** Root mean square of the residual. */
      rmse: number;
      /** SI unit of the figures. */
      unit: string;
      /** Noise of the channel. */
      noise_floor: number;
      /** The largest measured magnitude. */
      full_scale: number;
    };
    /** Figures of the muscle at one pressure. */
    Characteristics: {
      /** Gauge pressure. [Pa] */
      pressure: number;
      /** Force at the nominal length. [N] */
      blocked_force: number | null;
      /** Contraction without load. [1] */
      free_contraction: number | null;
      /** Code of the limit that the free contraction crosses. */
      free_contraction_flag: string | null;
      /** Work of one stroke from nominal length to free contraction. [J] */
      max_work: number | null;
      /** Ideal tension of all threads at nominal length. [N] */
      thread_tension_total: number | null;
    };
    /** Interval in which the flow of the valve does not depend on the downstream pressure. */
    Choked: {
      /** Start. [s] */
      from: number;
      /** End. [s] */
      to: number;
      /** Air flows in (fill) or out (exhaust). */
      side: "fill" | "exhaust";
    };
    /** A part of an order code. */
    CodePartAnswer: {
      /** As it stands in the code. */
      text: string;
      /** What it means. */
      meaning: string;
    };
    /** A column of numbers in one unit. */
    Column: {
      /** The unit, as a text. */
      unit: string;
      /** The numbers, one per row. */
      values: number[];
    };
    /** The figures of the model's error, and the points. */
    ComparisonAnswer: {
      /** Measurement kind. */
      kind: string;
      /** Number of rows of the measurements. */
      rows: number;
      /** Number of compared rows. */
      rows_used: number;
      /** The predicted channel, or several. */
      predicted: string;
      /** SI unit of the error; "1" = relative to the noise of each channel. */
      unit: string;
      /** Root mean square of the residual. */
      rmse: number | null;
      /** RMSE over the largest measured magnitude. */
      nrmse_percent: number | null;
      /** The largest measured magnitude. */
      full_scale: number | null;
      /** RMSE with whole groups left out of the fit. */
      holdout_rmse: number | null;
      /** Number of fitted values; with 0 no group was left out of anything. */
      fitted: number;
      /** Noise of the data, if it can be estimated. */
      noise_floor: number | null;
      /** How the noise was estimated. */
      noise_how: string;
      /** Mean of the residual. */
      residual_mean: number | null;
      /** Error of each channel when there are several. */
      channels: { [key: string]: components["schemas"]["ChannelError"] };
      /** Effect -> parameter -> value. */
      parameters: { [key: string]: { [key: string]: components["schemas"]["FittedParameter"] } };
      /** Correlations of the fitted parameters. */
      correlations: components["schemas"]["Correlation"][];
      /** Reason for leaving rows out -> number of rows. */
      excluded: { [key: string]: number };
      /** The residual over each variable that it may depend on. */
      where: components["schemas"]["ResidualProfile"][];
      /** The residual over two variables; null where there are too few points. */
      heat_map: components["schemas"]["HeatMap"] | null;
      /** What the squared residual is made of. */
      parts: components["schemas"]["ResidualPart"][];
      /** Autocorrelation and runs of the residual: does it look like noise? */
      whiteness: components["schemas"]["WhitenessAnswer"];
      /** Correlation of the residual with the input that drove the test, of rows with times. */
      cross: components["schemas"]["CrossCorrelationAnswer"][];
      /** Loops of the force residual, with the energy that the model misses. */
      loops: components["schemas"]["Loop"][];
      /** Where the model fails, as sentences. */
      sentences: string[];
      /** The error on measurements not used for the fit; null without them. */
      validation: components["schemas"]["ValidationAnswer"] | null;
      /** Remarks on the data. */
      messages: string[];
      /** Geometry of the muscle, fitted where it was free. */
      geometry: components["schemas"]["MuscleGeometry"];
      /** The points, curve by curve. */
      series: components["schemas"]["ComparisonSeries"][];
      /** Effects and values in the form of a request. */
      model: { [key: string]: { [key: string]: { [key: string]: number | string } } };
      /** Remarks on the muscle. */
      flags: components["schemas"]["Flag"][];
      /** RMSE of what the accuracy of the readings does not explain; a diagnosis counts with it. */
      rmse_beyond_accuracy: number | null;
      /** Values of the experiment in which all measurements agree, each with its origin. */
      experiment: { [key: string]: components["schemas"]["ExperimentValue"] };
      /** What nobody said and was assumed; the messages begin with it too. */
      assumptions: string[];
      /** Each measurement, with its own experiment. */
      specimens: components["schemas"]["Specimen"][];
      /** Errors of readings within the accuracy, which a fit allows for. */
      absorbed: components["schemas"]["Absorbed"][];
      /** Columns of the files that nothing is read from, and why. */
      unread: components["schemas"]["UnreadColumn"][];
    };
    /** A model, the measurements to compare it with, and whether to fit it. */
    ComparisonRequest: {
      /** Null: the drive's. */
      muscle?: components["schemas"]["MuscleInput"] | null;
      /** The effects of the model; null: the drive's, or those of the muscle preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Valve, tube, supply and load of transient measurements with a command channel; the measured command replaces the one stated here. */
      drive?: components["schemas"]["DriveDocument"] | null;
      /** One measurement to fit to. */
      measurement?: string | null;
      /** Measurements to fit to or to validate with, instead of 'measurement'. */
      measurements?: components["schemas"]["UsedMeasurement"][];
      /** Geometry to fit as well, within its tolerance. */
      free?: ("nominal_length" | "braid_diameter" | "braid_angle" | "wall_thickness" | "inside_diameter")[];
      /** Additional parameters to fit, as effect.parameter. */
      freed?: string[];
      /** Standard deviation of the predicted channel, when it is known: a number above 0 in SI, or a text with a unit. */
      noise?: number | string | null;
      /** For every measurement that does not say it in its own 'experiment'. */
      experiment?: components["schemas"]["ExperimentInput"] | null;
      /** Standard deviation of each channel of all measurements (% of the largest value), or sensors: 'length steel rule'. */
      accuracy?: string | null;
      /** Refuse instead of assuming what nobody said. */
      strict?: boolean;
      /** Entries of a diagnosis's 'context' that are wrong as stated: the channel is read in the other way, a quantity is fitted in diagnoses and fits. */
      use?: string[];
      /** Entries of 'context' that are right as stated. */
      keep?: string[];
      /** Fit the effects' parameters to the data. */
      fit?: boolean;
    };
    /** One curve of the comparison, e.g. all points of one pressure. */
    ComparisonSeries: {
      /** Name of the curve. */
      label: string;
      /** The predicted channel. */
      channel: string;
      /** SI unit of measured, predicted and residual. */
      unit: string;
      /** Used for the fit, or only for validation. */
      use: "fit" | "validation";
      /** Pressure of the series, when it has one. [Pa] */
      pressure: number | null;
      /** Time of each point. [s] */
      time: (number | null)[] | null;
      /** Contraction of each point. [1] */
      contraction: (number | null)[];
      /** Length of each point. [m] */
      length: (number | null)[];
      /** Pressure of each point. [Pa] */
      x_pressure: (number | null)[];
      /** dL/dt of each point. [m/s] */
      velocity: (number | null)[];
      /** -1 shortening, 1 lengthening, 0 at rest or unknown. */
      direction: (number | null)[];
      /** Measured. */
      measured: (number | null)[];
      /** Predicted. */
      predicted: (number | null)[];
      /** Measured minus predicted. */
      residual: (number | null)[];
    };
    /** The contraction at a force and pressure. */
    ContractionQuestion: {
      /** The muscle. */
      muscle: components["schemas"]["MuscleInput"];
      /** The effects of its model; null: those of the preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Temperature of the muscle. [K] */
      temperature?: number | string;
      /** Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none. */
      direction?: -1 | 0 | 1;
      /** Asks for a contraction. */
      question: "contraction";
      /** The force of the muscle. [N] */
      force: number | string;
      /** Gauge pressure in the muscle. [Pa] */
      pressure: number | string;
    };
    /** A position controller in SI. */
    ControllerAnswer: {
      /** Proportional gain. [1/m] */
      kp: number;
      /** Integral gain. [1/(m*s)] */
      ki: number;
      /** Derivative gain. [s/m] */
      kd: number;
      /** Command per reference. [1/m] */
      feed_forward: number;
      /** Filter time of the derivative. [s] */
      derivative_filter: number;
      /** Sample time. [s] */
      sample_time: number;
      /** Lowest command. [1] */
      output_min: number;
      /** Highest command. [1] */
      output_max: number;
      /** The part `controller` of a drive document, without its reference. */
      document: { [key: string]: string };
    };
    /** A sampled PID controller of the load's position. Gains without a unit are in percent of full command per mm (and s). */
    ControllerInput: {
      /** Kind of the controller; there is one. */
      type?: "pid";
      /** Proportional gain, %/mm. [1/m] */
      kp: number | string;
      /** Integral gain, %/(mm s). [1/(m*s)] */
      ki?: number | string | null;
      /** Derivative gain, % s/mm. [s/m] */
      kd?: number | string | null;
      /** Command per reference, %/mm. [1/m] */
      feed_forward?: number | string | null;
      /** Filter time of the derivative. Default 5 ms. [s] */
      derivative_filter?: number | string | null;
      /** Sample time. Default 1 ms. [s] */
      sample_time?: number | string | null;
      /** Lowest command. Default -1 for a valve, 0 for a regulator. [1] */
      output_min?: number | string | null;
      /** Highest command. Default 1. [1] */
      output_max?: number | string | null;
      /** Desired position, as a signal of time; a joint may state the angle instead. [m] */
      reference?: {
        /** Name of the shape. */
        shape: "step";
        /** When it steps. [s] */
        at?: number | string;
        /** The value after the step, inside the pulse, or in the first part of a period. [m] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [m] */
        initial?: number | string;
      } | {
        /** Name of the shape. */
        shape: "pulse";
        /** The value after the step, inside the pulse, or in the first part of a period. [m] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [m] */
        initial?: number | string;
        /** When the pulse begins. [s] */
        on?: number | string;
        /** When the pulse ends. [s] */
        off: number | string;
      } | {
        /** Name of the shape. */
        shape: "square";
        /** The value after the step, inside the pulse, or in the first part of a period. [m] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [m] */
        initial?: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** Share of each period with the first level. [1] */
        duty?: number | string;
        /** Peak to peak, the full height: level - initial. [m] */
        amplitude?: number | string;
      } | {
        /** Name of the shape. */
        shape: "triangle";
        /** Peak to peak, the full height: offset to offset + amplitude. [m] */
        amplitude: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** The value that the amplitude is added to. [m] */
        offset?: number | string;
      } | {
        /** Name of the shape. */
        shape: "ramp";
        /** The value before the ramp. [m] */
        from?: number | string;
        /** The value after the ramp. [m] */
        to: number | string;
        /** When the ramp begins. [s] */
        start?: number | string;
        /** How long the ramp lasts. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "sine";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [m] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [m] */
        offset?: number | string;
        /** Periods per second; or give the period. [Hz] */
        frequency?: number | string;
        /** Angle at t = 0. [rad] */
        phase?: number | string;
        /** Duration of one period. [s] */
        period?: number | string;
      } | {
        /** Name of the shape. */
        shape: "chirp";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [m] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [m] */
        offset?: number | string;
        /** Frequency at the start. [Hz] */
        from: number | string;
        /** Frequency at the end of the duration and after it. [Hz] */
        to: number | string;
        /** How long the frequency changes. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "random";
        /** How long each level lasts. [s] */
        hold: number | string;
        /** Number that the levels follow from; the same seed gives the same levels. */
        seed?: number;
        /** Lowest level. [m] */
        lower?: number | string;
        /** Highest level. [m] */
        upper: number | string;
      } | {
        /** Name of the shape. */
        shape: "table";
        /** Instants of the points, ascending. [s] */
        times: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Values of the points, as many as instants. [m] */
        values: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Joined by lines, or each value held until the next. */
        interpolation?: "linear" | "hold";
      } | null;
      /** Desired angle of an antagonist joint instead of the position: a constant, or a signal of time. [rad] */
      angle?: number | string | {
        /** Name of the shape. */
        shape: "step";
        /** When it steps. [s] */
        at?: number | string;
        /** The value after the step, inside the pulse, or in the first part of a period. [rad] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [rad] */
        initial?: number | string;
      } | {
        /** Name of the shape. */
        shape: "pulse";
        /** The value after the step, inside the pulse, or in the first part of a period. [rad] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [rad] */
        initial?: number | string;
        /** When the pulse begins. [s] */
        on?: number | string;
        /** When the pulse ends. [s] */
        off: number | string;
      } | {
        /** Name of the shape. */
        shape: "square";
        /** The value after the step, inside the pulse, or in the first part of a period. [rad] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [rad] */
        initial?: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** Share of each period with the first level. [1] */
        duty?: number | string;
        /** Peak to peak, the full height: level - initial. [rad] */
        amplitude?: number | string;
      } | {
        /** Name of the shape. */
        shape: "triangle";
        /** Peak to peak, the full height: offset to offset + amplitude. [rad] */
        amplitude: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** The value that the amplitude is added to. [rad] */
        offset?: number | string;
      } | {
        /** Name of the shape. */
        shape: "ramp";
        /** The value before the ramp. [rad] */
        from?: number | string;
        /** The value after the ramp. [rad] */
        to: number | string;
        /** When the ramp begins. [s] */
        start?: number | string;
        /** How long the ramp lasts. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "sine";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [rad] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [rad] */
        offset?: number | string;
        /** Periods per second; or give the period. [Hz] */
        frequency?: number | string;
        /** Angle at t = 0. [rad] */
        phase?: number | string;
        /** Duration of one period. [s] */
        period?: number | string;
      } | {
        /** Name of the shape. */
        shape: "chirp";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [rad] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [rad] */
        offset?: number | string;
        /** Frequency at the start. [Hz] */
        from: number | string;
        /** Frequency at the end of the duration and after it. [Hz] */
        to: number | string;
        /** How long the frequency changes. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "random";
        /** How long each level lasts. [s] */
        hold: number | string;
        /** Number that the levels follow from; the same seed gives the same levels. */
        seed?: number;
        /** Lowest level. [rad] */
        lower?: number | string;
        /** Highest level. [rad] */
        upper: number | string;
      } | {
        /** Name of the shape. */
        shape: "table";
        /** Instants of the points, ascending. [s] */
        times: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Values of the points, as many as instants. [rad] */
        values: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Joined by lines, or each value held until the next. */
        interpolation?: "linear" | "hold";
      } | null;
      /** Second set point, of an antagonist joint only. The controller then gives half of the difference of both commands, between -0.5 and 0.5 of a regulator. */
      stiffness?: components["schemas"]["StiffnessControlInput"] | null;
    };
    /** Correlation of two fitted parameters. */
    Correlation: {
      /** First parameter, as effect.parameter. */
      a: string;
      /** Second parameter, as effect.parameter. */
      b: string;
      /** Coefficient of correlation, -1 to 1. */
      value: number;
    };
    /** Covariance of fitted parameters: how sure each is, and how far one can replace another. */
    Covariance: {
      /** effect.parameter, or a dimension of the muscle; those that the data determine. */
      names: string[];
      /** Products of their SI units, one row per name. */
      matrix: number[][];
    };
    /** Correlation of the residual of a channel with the input of the test. */
    CrossCorrelationAnswer: {
      /** The predicted channel. */
      channel: string;
      /** Name of the input. */
      input: string;
      /** Rows by which the residual comes after the input; negative: before. */
      lags: number[];
      /** At each lag, -1 to 1. */
      correlation: (number | null)[];
      /** Half-width of the 95 % band of a residual independent of the input. */
      band: number;
      /** Share of the lags outside the band. */
      outside: number;
    };
    /** Force over pressure and contraction. */
    CurveColumns: {
      /** Gauge pressure. */
      pressure: components["schemas"]["Column"];
      /** Contraction ratio. */
      contraction: components["schemas"]["Column"];
      /** Force. */
      force: components["schemas"]["Column"];
    };
    /** Limits of the muscle; null where the preset does not state one. */
    CurveLimits: {
      /** Highest gauge pressure. [Pa] */
      max_pressure: number | null;
      /** Highest force. [N] */
      max_force: number | null;
      /** Highest contraction. [1] */
      max_contraction: number | null;
      /** Highest stretch beyond the nominal length. [1] */
      max_pretension: number | null;
      /** Contraction at which the ideal force is zero. [1] */
      ideal_max_contraction: number;
      /** Ideal force of the fully stretched braid, per pressure. [N] */
      braid_lock_force: (number | null)[];
    };
    /** A reference curve of the maker: not a measurement. */
    CurvePresetAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a reference curve. */
      kind: "curve";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Id of the muscle preset that it belongs to. */
      muscle: string;
      /** The numbers, column by column. */
      data_columns: components["schemas"]["CurveColumns"];
      /** Rows that are not used. */
      excluded?: components["schemas"]["Exclusion"][];
      /** Where the numbers come from, in a few words. */
      source: string;
      /** S: read in the cited source; S2: read second-hand; C: computed from cited data; D: derived or fitted for this project; M: general knowledge, not verified; E: engineering estimate, not verified; user: given by the user */
      grade: "S" | "S2" | "C" | "D" | "M" | "E" | "user";
      /** Remark on the numbers. */
      note?: string | null;
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** Force, stiffness, volume and diameter over the length, per pressure. */
    CurvesAnswer: {
      /** Gauge pressures of the rows. [Pa] */
      pressure: number[];
      /** Lengths of the columns. [m] */
      length: number[];
      /** Contractions of the columns. [1] */
      contraction: number[];
      /** Braid angle. [rad] */
      braid_angle: (number | null)[];
      /** Tension; 0 where the muscle would have to push, unless unclipped. [N] */
      force: ((number | null)[])[];
      /** dF/dL at constant pressure. [N/m] */
      stiffness: ((number | null)[])[];
      /** dF/dL at constant gas mass. [N/m] */
      stiffness_closed: ((number | null)[])[];
      /** Stiffness of the ideal muscle with this force at this length, 6 L F/(3 L² - b²); null unless asked for, and where it has no value. [N/m] */
      stiffness_from_force: ((number | null)[])[] | null;
      /** Stiffness of the straight line from the length without force, F/(L - L_min); null unless asked for. [N/m] */
      stiffness_secant: ((number | null)[])[] | null;
      /** Enclosed volume at the highest pressure. [m3] */
      volume: (number | null)[];
      /** Braid diameter at the highest pressure. [m] */
      diameter: (number | null)[];
      /** Outer diameter of the wall, at constant wall volume. [m] */
      outer_diameter: (number | null)[];
      /** Where new readings of the force are expected; null where the model was not fitted. */
      interval: components["schemas"]["ForceInterval"] | null;
      /** Limits of the muscle. */
      limits: components["schemas"]["CurveLimits"];
      /** Figures of the muscle at each pressure. */
      characteristics: components["schemas"]["Characteristics"][];
      /** Geometry of the muscle at rest, in all forms. */
      geometry: components["schemas"]["MuscleGeometry"];
      /** The effects used, with all their values. */
      model: components["schemas"]["ModelAnswer"];
      /** Null without load and fixed length. */
      over_pressure: components["schemas"]["OverPressure"] | null;
      /** The state at each pressure; empty without a load. */
      operating_points: components["schemas"]["OperatingPoint"][];
      /** Remarks on the answer. */
      flags: components["schemas"]["Flag"][];
    };
    /** A muscle, and the pressures and range of its curves. */
    CurvesRequest: {
      /** Gauge pressures of the curves. */
      pressures?: (number | string)[];
      /** Points along the length. */
      points?: number;
      /** Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none. */
      direction?: -1 | 0 | 1;
      /** Temperature of the muscle. [K] */
      temperature?: number | string;
      /** Also negative forces, which a muscle cannot exert. */
      unclipped?: boolean;
      /** Gas volume outside the muscle, for the closed valve. [m3] */
      dead_volume?: number | string;
      /** 1 isothermal, 1.4 adiabatic (air). */
      polytropic_exponent?: number;
      /** Start of the range; null: the pretension limit. [1] */
      contraction_from?: number | string | null;
      /** End of the range; null: the largest free contraction. [1] */
      contraction_to?: number | string | null;
      /** Constant load, for the operating points. [N] */
      load?: number | string | null;
      /** Fixed length, for force over pressure. [m] */
      fixed_length?: number | string | null;
      /** Also the stiffness that the force implies, and the secant stiffness. */
      further_stiffness?: boolean;
      /** The muscle. */
      muscle: components["schemas"]["MuscleInput"];
      /** The effects of its model; null: those of the preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
    };
    /** The nonlinear drive under a sine: the fundamental of the output over the sine. */
    DescribingPointAnswer: {
      /** Frequency. [Hz] */
      frequency: number;
      /** Amplitude of the input, in its unit. */
      amplitude: number;
      /** Gain, in the units of output per input; null without a run. */
      gain: number | null;
      /** Phase; null without a run. [rad] */
      phase: number | null;
      /** Share of everything but the fundamental in the output. [1] */
      distortion: number | null;
      /** What kept it from being a clean oscillation. */
      remark: string | null;
    };
    /** Goals of a position controller, for steps of the nonlinear drive. */
    DesignInput: {
      /** Largest overshoot as a share of the step. [1] */
      overshoot?: number | string;
      /** Time until the position stays within 2 % of the step. [s] */
      settling?: number | string;
      /** Height of the step. Default: a tenth of the range between the stops. [m] */
      step?: number | string | null;
      /** Whether the command must never reach its limits. */
      unsaturated?: boolean;
    };
    /** What the model is missing, and how certain that is. */
    DiagnosisAnswer: {
      /** Measurement kind. */
      kind: string;
      /** Number of rows of the measurements. */
      rows: number;
      /** Number of rows used. */
      rows_used: number;
      /** Reason for leaving rows out -> number of rows. */
      excluded: { [key: string]: number };
      /** The predicted channel, or several. */
      predicted: string;
      /** SI unit of the errors; "1" = relative to the noise of each channel. */
      unit: string;
      /** Error of the start model as given. */
      baseline: components["schemas"]["Baseline"];
      /** The error due to noise. */
      noise_floor: components["schemas"]["NoiseFloor"];
      /** Error of each channel when there are several. */
      channels: { [key: string]: components["schemas"]["ChannelError"] };
      /** The residual of the start model over each variable. */
      where: components["schemas"]["ResidualProfile"][];
      /** The start model with one more effect, the best first. */
      candidates: components["schemas"]["Candidate"][];
      /** The steps from the start model to the best one. */
      path: components["schemas"]["PathStep"][];
      /** The verdict. */
      verdict: components["schemas"]["Verdict"];
      /** Effect -> parameter -> value, of the best model. */
      parameters: { [key: string]: { [key: string]: components["schemas"]["FittedParameter"] } };
      /** Correlations of the fitted parameters of the best model. */
      correlations: components["schemas"]["Correlation"][];
      /** Geometry of the muscle of the best model. */
      geometry: components["schemas"]["MuscleGeometry"];
      /** Muscle and effects; of a transient also 'drive': the drive document with both inside, which a comparison takes. */
      model: { [key: string]: unknown };
      /** Constants that the best model fitted as well, as effect.parameter. */
      freed: string[];
      /** Effects of the catalogue that were not tried, with the reason. */
      not_tried: components["schemas"]["NotTried"][];
      /** Remarks on the data and the search. */
      messages: string[];
      /** Values of the experiment in which all measurements agree, each with its origin. */
      experiment: { [key: string]: components["schemas"]["ExperimentValue"] };
      /** What nobody said and was assumed; the messages begin with it too. */
      assumptions: string[];
      /** Each measurement, with its own experiment. */
      specimens: components["schemas"]["Specimen"][];
      /** Errors of readings within the accuracy, which a fit allows for. */
      absorbed: components["schemas"]["Absorbed"][];
      /** Entries that may be wrong instead, the most convincing first. */
      context: components["schemas"]["DoubtfulEntry"][];
      /** Quantity -> range of the data: rest_length, pressure, contraction, speed, temperature, load, mass, supply, as far as they were measured or stated. */
      envelope: { [key: string]: components["schemas"]["MeasuredRange"] };
      /** Of the fitted values of the best model; null where the data cannot separate them. */
      covariance: components["schemas"]["FittedCovariance"] | null;
      /** Columns of the files that nothing is read from, and why. */
      unread: components["schemas"]["UnreadColumn"][];
    };
    /** The start model and the measurements to explain. */
    DiagnosisRequest: {
      /** Null: the drive's. */
      muscle?: components["schemas"]["MuscleInput"] | null;
      /** The effects of the model; null: the drive's, or those of the muscle preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Valve, tube, supply and load of transient measurements with a command channel; the measured command replaces the one stated here. */
      drive?: components["schemas"]["DriveDocument"] | null;
      /** One measurement to fit to. */
      measurement?: string | null;
      /** Measurements to fit to or to validate with, instead of 'measurement'. */
      measurements?: components["schemas"]["UsedMeasurement"][];
      /** Geometry to fit as well, within its tolerance. */
      free?: ("nominal_length" | "braid_diameter" | "braid_angle" | "wall_thickness" | "inside_diameter")[];
      /** Additional parameters to fit, as effect.parameter. */
      freed?: string[];
      /** Standard deviation of the predicted channel, when it is known: a number above 0 in SI, or a text with a unit. */
      noise?: number | string | null;
      /** For every measurement that does not say it in its own 'experiment'. */
      experiment?: components["schemas"]["ExperimentInput"] | null;
      /** Standard deviation of each channel of all measurements (% of the largest value), or sensors: 'length steel rule'. */
      accuracy?: string | null;
      /** Refuse instead of assuming what nobody said. */
      strict?: boolean;
      /** Entries of a diagnosis's 'context' that are wrong as stated: the channel is read in the other way, a quantity is fitted in diagnoses and fits. */
      use?: string[];
      /** Entries of 'context' that are right as stated. */
      keep?: string[];
    };
    /** A statement about the data that may be wrong, with the evidence. */
    DoubtfulEntry: {
      /** Id, for 'use' and 'keep'. */
      hypothesis: string;
      /** Field of the muscle, or channel. */
      field: string;
      /** Stated value, SI; null for a way of reading. */
      stated: number | null;
      /** What explains the data: SI value, or in words. */
      value: number | string | null;
      /** Standard error of the value; null where there is none. */
      stderr: number | null;
      /** SI unit of stated, value and stderr. */
      unit: string;
      /** Share of the error above the noise that it explains by itself. */
      explains: number;
      /** Error of the best model with it. */
      rmse_after: number;
      /** Probability against the best model without it. */
      confidence: number;
      /** Effects that are missing with it. */
      effects: string[];
      /** To be answered before anything else. */
      asked: boolean;
      /** Would be asked about, but the request keeps it. */
      kept: boolean;
      /** The evidence, as a sentence. */
      sentence: string;
    };
    /** A drive document to start from; its content is checked when it is used. */
    DriveAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a drive. */
      kind: "drive";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** The document to start from. */
      document: { [key: string]: unknown };
      /** Path in the document -> source of the value. */
      grounds?: { [key: string]: components["schemas"]["Ground"] };
      /** Published figures of the drive; null where there are none. */
      paper?: components["schemas"]["PaperFigures"] | null;
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** A complete drive. Strokes are positive when the muscle gets shorter. Pressures are gauge; a text like "7 bar(a)" is converted with the ambient pressure of the document. */
    DriveDocument: {
      /** Version of the document. */
      schema?: 1;
      /** Title for display. */
      title?: string;
      /** The muscle; both muscles of an antagonist pair. */
      muscle: components["schemas"]["MuscleInput"];
      /** The effects of the model; null: those of the presets. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** The compressed air before the valve. */
      supply: components["schemas"]["SupplyInput"];
      /** The valve. */
      valve: components["schemas"]["ValveInput"];
      /** States that the valve is a pressure regulator; null: it is one only if its preset is. */
      regulator?: components["schemas"]["RegulatorInput"] | null;
      /** Default: the valve is on the muscle, but a diagnosis tries a typical tube (4 mm, 1 m) as an explanation. null: there is no tube, and a diagnosis tries none. */
      tube?: components["schemas"]["TubeInput"] | null;
      /** A one-way flow control valve on the muscle; null: there is none. */
      flow_control?: components["schemas"]["FlowControlInput"] | null;
      /** A quick exhaust valve on the muscle; null: there is none. */
      quick_exhaust?: components["schemas"]["QuickExhaustInput"] | null;
      /** Pulse-width modulation: the valves switch, and the command is their duty ratio; null: the valve opens as far as it is commanded. */
      pwm?: components["schemas"]["PwmInput"] | null;
      /** Fitting presets; they add their port volumes. */
      fittings?: string[];
      /** The load. Default: none. */
      load?: components["schemas"]["LoadInput"];
      /** Opening of the valve: 1 fill, 0 closed, -1 exhaust; for a regulator, the share of its range. Where a shape has no value, e.g. outside a pulse, the valve exhausts (0 for a regulator). Not needed with a controller or a measurement, which supply the command. [1] */
      command?: {
        /** Name of the shape. */
        shape: "step";
        /** When it steps. [s] */
        at?: number | string;
        /** The value after the step, inside the pulse, or in the first part of a period. [1] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [1] */
        initial?: number | string;
      } | {
        /** Name of the shape. */
        shape: "pulse";
        /** The value after the step, inside the pulse, or in the first part of a period. [1] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [1] */
        initial?: number | string;
        /** When the pulse begins. [s] */
        on?: number | string;
        /** When the pulse ends. [s] */
        off: number | string;
      } | {
        /** Name of the shape. */
        shape: "square";
        /** The value after the step, inside the pulse, or in the first part of a period. [1] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [1] */
        initial?: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** Share of each period with the first level. [1] */
        duty?: number | string;
        /** Peak to peak, the full height: level - initial. [1] */
        amplitude?: number | string;
      } | {
        /** Name of the shape. */
        shape: "triangle";
        /** Peak to peak, the full height: offset to offset + amplitude. [1] */
        amplitude?: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** The value that the amplitude is added to. [1] */
        offset?: number | string;
      } | {
        /** Name of the shape. */
        shape: "ramp";
        /** The value before the ramp. [1] */
        from?: number | string;
        /** The value after the ramp. [1] */
        to?: number | string;
        /** When the ramp begins. [s] */
        start?: number | string;
        /** How long the ramp lasts. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "sine";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [1] */
        amplitude?: number | string;
        /** The value that the amplitude is added to. [1] */
        offset?: number | string;
        /** Periods per second; or give the period. [Hz] */
        frequency?: number | string;
        /** Angle at t = 0. [rad] */
        phase?: number | string;
        /** Duration of one period. [s] */
        period?: number | string;
      } | {
        /** Name of the shape. */
        shape: "chirp";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [1] */
        amplitude?: number | string;
        /** The value that the amplitude is added to. [1] */
        offset?: number | string;
        /** Frequency at the start. [Hz] */
        from: number | string;
        /** Frequency at the end of the duration and after it. [Hz] */
        to: number | string;
        /** How long the frequency changes. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "random";
        /** How long each level lasts. [s] */
        hold: number | string;
        /** Number that the levels follow from; the same seed gives the same levels. */
        seed?: number;
        /** Lowest level. [1] */
        lower?: number | string;
        /** Highest level. [1] */
        upper?: number | string;
      } | {
        /** Name of the shape. */
        shape: "table";
        /** Instants of the points, ascending. [s] */
        times: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Values of the points, as many as instants. [1] */
        values: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Joined by lines, or each value held until the next. */
        interpolation?: "linear" | "hold";
      } | null;
      /** Controller that generates the command. */
      controller?: components["schemas"]["ControllerInput"] | null;
      /** How the air behaves, and what surrounds the drive. */
      gas?: components["schemas"]["GasInput"];
      /** The end stops. */
      stops?: components["schemas"]["StopsInput"];
      /** Length of the run. [s] */
      duration?: number | string;
      /** Gauge pressure in the muscle at t = 0. [Pa] */
      start_pressure?: number | string;
      /** Where the load is released at t = 0. Default: where it rests. */
      start?: components["schemas"]["StartInput"];
    };
    /** Limits stated by the maker (null = not known), and the end stops. */
    DriveLimits: {
      /** Highest gauge pressure. [Pa] */
      max_pressure: number | null;
      /** Highest force. [N] */
      max_force: number | null;
      /** Highest contraction. [1] */
      max_contraction: number | null;
      /** Highest stretch beyond the nominal length. [1] */
      max_pretension: number | null;
      /** Lower stop as a position of the load. [m] */
      position_min: number;
      /** Upper stop as a position of the load. [m] */
      position_max: number;
    };
    /** One physical effect, as its file declares it. */
    EffectAnswer: {
      /** The name of the file that declares it. */
      id: string;
      /** Its name. */
      title: string;
      /** Part of the drive or branch of physics that it belongs to. */
      family: string;
      /** static, rate, hysteretic, dynamic or measurement. */
      type: string;
      /** Why it exists. */
      cause: string;
      /** LaTeX. */
      equation: string;
      /** The equation as MathML. */
      equation_mathml: string;
      /** Its numbers. */
      parameters: components["schemas"]["EffectParameter"][];
      /** Measurement kinds that reveal it. */
      kinds: string[];
      /** How it shows in the residual. */
      signature: components["schemas"]["Signature"];
      /** Effects that look alike. */
      confused_with: components["schemas"]["Twin"][];
      /** Where it is described. */
      references: components["schemas"]["SourceText"][];
      /** The places in the model where it acts. */
      slots: string[];
    };
    /** One number of an effect, in SI. */
    EffectParameter: {
      /** Its key in a request. */
      name: string;
      /** LaTeX. */
      symbol: string;
      /** The symbol as MathML. */
      symbol_mathml: string;
      /** SI unit of all figures here. */
      unit: string;
      /** A typical value. */
      default: number;
      /** Lower bound of the plausible range. */
      lower: number;
      /** Upper bound of the plausible range. */
      upper: number;
      /** The value at which the effect vanishes. */
      off: number | null;
      /** Whether a fit frees it by default. */
      fitted: boolean;
      /** What it is. */
      description: string;
      /** Source of the typical value. */
      source: components["schemas"]["SourceText"];
    };
    /** All known effects, and the effect files that could not be loaded. */
    EffectsAnswer: {
      /** All known effects. */
      effects: components["schemas"]["EffectAnswer"][];
      /** Effect files that could not be loaded. */
      problems: components["schemas"]["FileProblem"][];
    };
    /** The body of every error. */
    ErrorBody: {
      /** What is wrong. */
      error: components["schemas"]["ErrorDetail"];
    };
    /** What is wrong, where, and what would be right. */
    ErrorDetail: {
      /** Machine-readable kind. */
      code: string;
      /** What is wrong, for people. */
      message: string;
      /** Path of the field in the request. */
      field: string | null;
      /** What would be right. */
      hint: string | null;
    };
    /** A row that is not used, and why. */
    Exclusion: {
      /** Number of the row, from 0. */
      index: number;
      /** Why it is not used. */
      why: string;
    };
    /** An experiment that separates two effects that look alike. */
    Experiment: {
      /** Ids of the two effects. */
      pair: string[];
      /** What separates them according to the catalogue; empty without an entry. */
      declared: string;
      /** How to do it, in words; empty where none of the known experiments separates them. */
      protocol: string;
      /** Expected difference, in standard deviations of one reading. */
      separation: number;
      /** How long it takes; null without a protocol. */
      minutes: number | null;
      /** Whether the two models predict different results for this rig. */
      matters: boolean;
      /** Simulated experiment where the models as they are differ most. */
      differs_in: string;
      /** By how many standard deviations of one reading. */
      difference: number;
    };
    /** What is said about the experiment of each measurement, and what is open. */
    ExperimentAnswer: {
      /** One entry per measurement of the request. */
      measurements: components["schemas"]["StatedExperiment"][];
      /** What a diagnosis would assume, in the words with which it begins. */
      assumptions: string[];
      /** A conflict, or a missing value without which the diagnosis is refused. */
      problem: components["schemas"]["ErrorDetail"] | null;
    };
    /** A field of the experiment, for a form. */
    ExperimentField: {
      /** Name: the key of 'experiment' in a request. 'accuracy_length' and the like are parts of its 'accuracy'. */
      field: string;
      /** In words. */
      title: string;
      /** In SI, or a text; null = nobody said it. */
      value: number | string | null;
      /** SI unit; "" of a text. */
      unit: string;
      /** Units for a form. */
      units: string[];
      /** Who says it; null with value. */
      origin: "file" | "you" | "preset" | "suggested" | "assumed" | null;
      /** Place in the file, or the preset. */
      where: string;
      /** This kind of test needs it. */
      required: boolean;
      /** Required, and neither the file nor the user says it: ask before the first diagnosis. With origin 'assumed' a diagnosis goes on with the value; with value null it does not. */
      unanswered: boolean;
      /** The question of the field. */
      question: string;
      /** What it is needed for. */
      why: string;
      /** A value that the data suggest, SI; never used unasked. */
      proposed: number | string | null;
      /** Smallest allowed value, SI. */
      least: number | null;
      /** Largest allowed value, SI. */
      most: number | null;
      /** Allowed texts, or proposals of texts; empty = any. */
      choices: string[];
      /** Only the choices are allowed. */
      closed: boolean;
      /** A valid value, as a text. */
      example: string;
      /** What says it on the command line. */
      option: string;
    };
    /** What the user says about the experiment behind one measurement; it takes precedence over the file. */
    ExperimentInput: {
      /** Id of the preset of this specimen. Default: the file's, else that of the request. */
      muscle?: string | {
        /** The value itself. */
        value: string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Length of this specimen without air and load. Default: the file's, else the length of the request's muscle; the preset's default is assumed and the answer says so. [m] */
      rest_length?: number | string | {
        /** The value itself. */
        value: number | string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** A mass or a force. Default: the file's, else the drive's. [kg or N] */
      load?: string | {
        /** The value itself. */
        value: string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Supply pressure, gauge. Default: file, drive. [Pa] */
      supply?: number | string | {
        /** The value itself. */
        value: number | string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Id of a valve preset. Default: the drive's. */
      valve?: string | {
        /** The value itself. */
        value: string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Id of a tube preset, "4 mm x 1 m" or "none". Default: the drive's. */
      tube?: string | {
        /** The value itself. */
        value: string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Contractions between which the load can move. Default: the drive's. */
      stops?: string | {
        /** The value itself. */
        value: string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Angle between the motion of the load and the horizontal. Default: drive, 90 deg. [rad] */
      inclination?: number | string | {
        /** The value itself. */
        value: number | string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Which end of the muscle is fixed. It is recorded; no figure depends on it. */
      fixed_end?: "upper" | "lower" | "both" | {
        /** The value itself. */
        value: "upper" | "lower" | "both";
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Reading of the force sensor without force; it is subtracted. [N] */
      force_zero?: number | string | {
        /** The value itself. */
        value: number | string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Reading of the pressure sensor at atmospheric pressure; it is subtracted. [Pa] */
      pressure_zero?: number | string | {
        /** The value itself. */
        value: number | string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
      /** Standard deviation of each channel, as 'length 1 mm, force 0.5 %, pressure 20 mbar' (% of the largest value), or a sensor: 'length steel rule'. Default: that of the request. */
      accuracy?: string | {
        /** The value itself. */
        value: string;
        /** Who says it. Default: you. */
        origin?: "you" | "suggested" | "preset";
      } | null;
    };
    /** One value of the experiment, and who says it. */
    ExperimentValue: {
      /** In SI, or a text. */
      value: number | string;
      /** SI unit; "" of a text, "1" of a share. */
      unit: string;
      /** The file, the user (you), a preset that was chosen, a proposal that the user took over (suggested), or nobody (assumed). */
      origin: "file" | "you" | "preset" | "suggested" | "assumed";
      /** Line or cell of the file, option or field, or the preset. */
      where: string;
    };
    /** A simulated design that fulfils the task; coarse figures, for a plot of the alternatives. */
    ExploredDesign: {
      /** Id of the preset. */
      muscle: string;
      /** Nominal length of each muscle. [m] */
      nominal_length: number;
      /** Number of parallel muscles. */
      parallel: number;
      /** Id of the preset. */
      valve: string;
      /** Id of the preset; null without a tube. */
      tube: string | null;
      /** Gauge pressure of the supply. [Pa] */
      pressure: number;
      /** Time for the stroke. [s] */
      time: number;
      /** Air per cycle at ANR. [m^3] */
      air_volume_anr: number;
      /** Share by which the static force exceeds the load. [1] */
      force_reserve: number;
      /** Stiffness at the load, valve open. [N/m] */
      stiffness: number;
      /** On the Pareto front of the explored designs. */
      front: boolean;
    };
    /** A format. */
    ExportFormat: {
      /** What ``as`` takes. */
      id: string;
      /** Its name for display. */
      title: string;
      /** What is in it, in a few words. */
      note: string;
      /** Whether it holds a whole drive; otherwise the muscle of one. */
      drives: boolean;
      /** Whether it holds a muscle alone; otherwise it needs a drive. */
      muscles: boolean;
    };
    /** What is taken along, and how: exactly one of muscle, model and drive. */
    ExportRequest: {
      /** Id of a format; GET /api/exports lists them. */
      as: string;
      /** A muscle, with its effects. */
      muscle?: components["schemas"]["MuscleInput"] | null;
      /** The effects of the muscle; null: those of the preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** A model that was fitted to measurements, with its drive if it has one. */
      model?: components["schemas"]["SavedModel"] | null;
      /** A drive document, or the id of a drive preset. */
      drive?: components["schemas"]["DriveDocument"] | string | null;
      /** Title in the files. Default: that of the document, or preset and length. */
      title?: string;
      /** Name of the files without its ending. Default: made from the title. */
      name?: string | null;
    };
    /** A file that was not loaded, and why. */
    FileProblem: {
      /** Name of the file. */
      file: string;
      /** Why it was not loaded. */
      message: string;
    };
    /** How well the model describes its data. */
    FitError: {
      /** Root mean square of the residual. */
      rmse: number;
      /** The same of groups that were left out of the fit. */
      holdout_rmse: number | null;
      /** Noise of the data; null where it cannot be estimated. */
      noise: number | null;
      /** SI unit; "1" = relative to the noise of each channel. */
      unit: string;
    };
    /** How the values of a muscle were fitted to measurements. */
    FitRecord: {
      /** Measurements it was fitted to. */
      files: string[];
      /** Date and time, ISO 8601, UTC. */
      made: string;
      /** Predicted channel -> error left (rms), SI. */
      errors: { [key: string]: number };
      /** Quantity -> range in which it was measured. */
      envelope?: { [key: string]: components["schemas"]["MeasuredSpan"] };
      /** Of the fitted values; null where the data cannot separate them. */
      covariance?: components["schemas"]["Covariance"] | null;
      /** What was stated for geometry that the data corrected, SI. */
      stated?: { [key: string]: number };
    };
    /** Covariance of the fitted values that the data determine. */
    FittedCovariance: {
      /** effect.parameter, or a dimension of the muscle. */
      names: string[];
      /** Products of their SI units, one row per name. */
      matrix: number[][];
    };
    /** A measurement that the model was fitted to. */
    FittedFile: {
      /** Name of the file or preset. */
      name: string;
      /** Of the file; null for a preset of the program. */
      sha256: string | null;
      /** Number of its rows. */
      rows: number;
      /** What it was made with, and who says it, in words. */
      experiment?: { [key: string]: string };
    };
    /** A fitted model with its measurements, and the id of the preset that it becomes. */
    FittedMuscleRequest: {
      /** Null: the drive's. */
      muscle?: components["schemas"]["MuscleInput"] | null;
      /** The effects of the model; null: the drive's, or those of the muscle preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Valve, tube, supply and load of transient measurements with a command channel; the measured command replaces the one stated here. */
      drive?: components["schemas"]["DriveDocument"] | null;
      /** One measurement to fit to. */
      measurement?: string | null;
      /** Measurements to fit to or to validate with, instead of 'measurement'. */
      measurements?: components["schemas"]["UsedMeasurement"][];
      /** Geometry to fit as well, within its tolerance. */
      free?: ("nominal_length" | "braid_diameter" | "braid_angle" | "wall_thickness" | "inside_diameter")[];
      /** Additional parameters to fit, as effect.parameter. */
      freed?: string[];
      /** Standard deviation of the predicted channel, when it is known: a number above 0 in SI, or a text with a unit. */
      noise?: number | string | null;
      /** For every measurement that does not say it in its own 'experiment'. */
      experiment?: components["schemas"]["ExperimentInput"] | null;
      /** Standard deviation of each channel of all measurements (% of the largest value), or sensors: 'length steel rule'. */
      accuracy?: string | null;
      /** Refuse instead of assuming what nobody said. */
      strict?: boolean;
      /** Entries of a diagnosis's 'context' that are wrong as stated: the channel is read in the other way, a quantity is fitted in diagnoses and fits. */
      use?: string[];
      /** Entries of 'context' that are right as stated. */
      keep?: string[];
      /** Of the preset: letters, digits, hyphens. */
      id: string;
      /** Its name for display; empty = the id. */
      title?: string;
    };
    /** One parameter as used or fitted. */
    FittedParameter: {
      /** Value in SI. */
      value: number;
      /** Standard error; null when not fitted or not determined. */
      stderr: number | null;
      /** SI unit. */
      unit: string;
      /** The fit stopped at a bound. */
      at_bound: boolean;
      /** Whether the fit could change it. */
      fitted: boolean;
    };
    /** A fitting or silencer, with the dead volume of its port. */
    FittingAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a fitting. */
      kind: "fitting";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Effect id -> parameter -> value: the effects that the model has by default. */
      effects?: { [key: string]: { [key: string]: components["schemas"]["Quantity"] } };
      /** Catalogue data, by name. */
      data?: { [key: string]: components["schemas"]["Quantity"] };
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** A remark on an answer: a crossed limit, a value out of reach, an unverified figure. */
    Flag: {
      /** Machine-readable kind. */
      code: string;
      /** Explanation for the user. */
      message: string;
      /** The input it belongs to. */
      field?: string | null;
    };
    /** A one-way flow control valve between tube (or valve) and muscle: it throttles the air in one direction, and lets it flow freely in the other. */
    FlowControlInput: {
      /** in: it throttles the filling of the muscle; out: its venting. */
      meter: "in" | "out";
      /** Conductance in the throttled direction, ISO 6358, as the screw is set. [m^3/(s*Pa)] */
      sonic_conductance: number | string;
      /** Critical pressure ratio b of both directions. Default: 0.3. [1] */
      critical_pressure_ratio?: number | string | null;
      /** Conductance in the free direction, through the check valve. Default: no resistance. [m^3/(s*Pa)] */
      free_conductance?: number | string | null;
    };
    /** Force over pressure at the fixed length, in both directions of motion. */
    ForceAtLength: {
      /** While shortening. [N] */
      filling: (number | null)[];
      /** While lengthening. [N] */
      venting: (number | null)[];
    };
    /** Where new readings of the force are expected, where the model was measured; wider elsewhere. */
    ForceInterval: {
      /** Lower ends. [N] */
      low: ((number | null)[])[];
      /** Upper ends. [N] */
      high: ((number | null)[])[];
      /** Share of the readings between them. [1] */
      share: number;
    };
    /** A force that depends on the position of the load, linear between the points. */
    ForceOverStroke: {
      /** Strokes of the load, ascending. */
      strokes: (number | string)[];
      /** Force against the pull at these strokes. */
      forces: (number | string)[];
    };
    /** The formats. */
    FormatsAnswer: {
      /** By id. */
      formats: components["schemas"]["ExportFormat"][];
    };
    /** The air and its surroundings. */
    GasInput: {
      /** 1 isothermal, 1.4 adiabatic. Default: none; the gas then has a temperature that follows from the energy balance with heat exchange, and its mass is conserved. [1] */
      polytropic_exponent?: number | string | null;
      /** Heat transfer coefficient between the gas in the muscle and its wall, for the energy balance. 0 is adiabatic. Not verified: 20 to 60 at rest, several hundred during a fast fill. [W/(m^2*K)] */
      wall_heat_transfer?: number | string;
      /** Temperature of the supply and the surroundings. [K] */
      temperature?: number | string;
      /** Absolute pressure of the surroundings. [Pa] */
      ambient_pressure?: number | string;
      /** Gas volume in addition to muscle and tube: ports, a reservoir. [m3] */
      dead_volume?: number | string;
    };
    /** The muscle at rest; an unknown wall thickness is left out. */
    Geometry: {
      /** Bore. */
      inside_diameter: components["schemas"]["Quantity"];
      /** Diameter of the braid at the braid angle. */
      braid_diameter: components["schemas"]["Quantity"];
      /** Angle between thread and axis. */
      braid_angle: components["schemas"]["Quantity"];
      /** Length between the fittings. */
      nominal_length: components["schemas"]["Quantity"];
      /** Wall of the bladder. */
      wall_thickness?: components["schemas"]["Quantity"] | null;
    };
    /** A figure that is to be small, or large. */
    Goal: {
      /** Path of the figure. */
      figure: string;
      /** What is better. */
      direction?: "minimise" | "maximise";
    };
    /** The goals of a design. */
    GoalsAnswer: {
      /** Largest overshoot. [1] */
      overshoot: number;
      /** Latest settling time. [s] */
      settling: number;
      /** Height of the step. [m] */
      step: number;
      /** Whether the command must never reach its limits. */
      unsaturated: boolean;
    };
    /** All combinations of the values. */
    GridMethod: {
      /** Name of the method. */
      type: "grid";
    };
    /** Source of a value of a drive document. */
    Ground: {
      /** Where the value comes from, in a few words. */
      source: string;
      /** S: read in the cited source; S2: read second-hand; C: computed from cited data; D: derived or fitted for this project; M: general knowledge, not verified; E: engineering estimate, not verified; user: given by the user */
      grade: "S" | "S2" | "C" | "D" | "M" | "E" | "user";
      /** Remark on the value. */
      note?: string | null;
    };
    /** The server is up. */
    Health: {
      /** The word 'ok'. */
      status: "ok";
      /** Version of mckibben. */
      version: string;
      /** Version of the plotly bundle, for its link's ``?v=``. */
      plotly: string;
      /** Processes for diagnoses, sizings and reports; 0 = threads of the server. */
      workers: number;
      /** Jobs in these processes. */
      running: number;
      /** Jobs in the queue. */
      waiting: number;
      /** Jobs that may wait; further ones are refused with status 429. */
      queue: number;
      /** The processes by sort of work; empty without workers. */
      lanes: components["schemas"]["LaneState"][];
      /** Most memory that the server itself took so far [bytes]; null on Windows. */
      memory: number | null;
      /** Program -> version. */
      versions: { [key: string]: string };
      /** Whether the integrators are being compiled for this machine: once after an installation, about 20 s of a core. What needs them waits. */
      compiling: boolean;
      /** Whether the server has a folder for the user's presets. */
      can_save_presets: boolean;
    };
    /** The residual over two variables; rows are y, null where there are no points. */
    HeatMap: {
      /** The variable of the columns. */
      x: string;
      /** The variable of the rows. */
      y: string;
      /** Boundaries of the columns, SI; one more than columns. */
      x_edges: (number | null)[];
      /** Boundaries of the rows, SI; one more than rows. */
      y_edges: (number | null)[];
      /** Mean residual of each cell, SI. */
      mean: ((number | null)[])[];
      /** Root mean square of the residual of each cell, SI. */
      rms: ((number | null)[])[];
      /** Number of points of each cell. */
      count: number[][];
    };
    /** One effect that the start model lacks. */
    Hidden: {
      /** What is hidden, in a few words. */
      title: string;
      /** What it does, and how it shows in the data. */
      what: string;
      /** Effect ids accepted as right answers. */
      effects: string[];
    };
    /** The versions of a project, the last one first. */
    HistoryAnswer: {
      /** The versions that are kept. */
      history: components["schemas"]["RevisionInfo"][];
    };
    /** An earlier model in the user's history. */
    HistoryStep: {
      /** What the model is called in the report. */
      label: string;
      /** As in the request. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Additional parameters that were fitted, as effect.parameter. */
      freed?: string[];
      /** Null: that of the request. */
      muscle?: components["schemas"]["MuscleInput"] | null;
    };
    /** Width of the loop of filling and venting at the load, far from its ends; null where it is not held. */
    HysteresisLoop: {
      /** Gauge pressures of the curves. [Pa] */
      pressure: number[];
      /** Distance of the branches in length, at equal pressure. [m] */
      stroke: (number | null)[];
      /** The same as a share of the nominal length. [1] */
      share: (number | null)[];
      /** Distance of the branches in pressure, at equal length. [Pa] */
      pressure_width: (number | null)[];
    };
    /** The requested value in SI, with flags. */
    InverseAnswer: {
      /** The question that was asked. */
      question: "pressure" | "contraction" | "working_range" | "stroke_pressure";
      /** The answer; null when there is none (a flag says why). */
      value: number | null;
      /** SI unit of the value. */
      unit: string;
      /** Further figures in SI. */
      details: { [key: string]: number | null };
      /** Remarks on the answer. */
      flags: components["schemas"]["Flag"][];
    };
    /** The pulley of an antagonist pair, and its second muscle. */
    Joint: {
      /** Pulley angle from the middle, positive as the first muscle pulls. [rad] */
      angle: (number | null)[];
      /** Torque of both muscles on the pulley. [N*m] */
      torque: (number | null)[];
      /** Stiffness of the joint at constant pressures. [N*m/rad] */
      stiffness: (number | null)[];
      /** Tension of the second muscle. [N] */
      counter_force: (number | null)[];
      /** Pressure in the second muscle. [Pa] */
      counter_pressure: (number | null)[];
      /** Command of the second valve or regulator. [1] */
      counter_command: (number | null)[];
      /** Mass flow into the second muscle. [kg/s] */
      counter_mass_flow: (number | null)[];
      /** Mass flow from the supply to the second muscle. [kg/s] */
      counter_supply_flow: (number | null)[];
      /** Mass flow from the second muscle to the atmosphere. [kg/s] */
      counter_exhaust_flow: (number | null)[];
      /** Braid diameter of the second muscle at mid-span. [m] */
      counter_diameter: (number | null)[];
      /** Set point of the angle; null without a controller. [rad] */
      angle_reference: (number | null)[] | null;
      /** Set point of the stiffness; null where the stiffness is not controlled. [N*m/rad] */
      stiffness_reference: (number | null)[] | null;
      /** Root mean square of stiffness minus set point over the rows; null without one. [N*m/rad] */
      stiffness_error: number | null;
    };
    JsonValue: unknown;
    /** All that the user keeps. */
    KeptAnswer: {
      /** Measurements and presets, the last one first. */
      items: components["schemas"]["KeptItem"][];
      /** Those that can be restored, the last one first. */
      deleted: components["schemas"]["KeptItem"][];
      /** Of all measurements on the disk, with deleted ones [bytes]. */
      size: number;
      /** Most that they may take [bytes]. */
      quota: number;
    };
    /** A measurement file or a preset of the user. */
    KeptItem: {
      /** 'files' for a measurement file, else the kind of preset. */
      kind: "files" | "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks";
      /** Id of the measurement or preset. */
      id: string;
      /** File name or title. */
      name: string;
      /** On the disk [bytes]. */
      size: number;
      /** When it was stored, renamed or deleted [s since 1970]. */
      changed: number;
      /** Whether the file is read with corrections of the user. */
      corrected: boolean;
    };
    /** Processes for one sort of work. */
    LaneState: {
      /** Diagnoses and the like; files that are read; comparisons and models with typed terms. */
      name: "long" | "files" | "models";
      /** Jobs that run at a time. */
      processes: number;
      /** Jobs that run. */
      running: number;
      /** Jobs that wait. */
      waiting: number;
    };
    /** Latin hypercube: each quantity is spread evenly over its distribution or range. */
    LatinHypercubeMethod: {
      /** Name of the method. */
      type: "latin_hypercube";
      /** Number of runs. */
      runs?: number;
      /** The random numbers follow from it: the same seed gives the same runs. */
      seed?: number;
    };
    /** A limit of a figure; a run without this figure does not keep it. */
    Limit: {
      /** Path of the figure. */
      figure: string;
      /** Lower limit. */
      at_least?: number | string | null;
      /** Upper limit. */
      at_most?: number | string | null;
    };
    /** Limits stated by the maker; unknown ones are left out. */
    Limits: {
      /** Highest gauge pressure. */
      max_pressure?: components["schemas"]["Quantity"] | null;
      /** Highest force. */
      max_force?: components["schemas"]["Quantity"] | null;
      /** Highest contraction, share of the nominal length. */
      max_contraction?: components["schemas"]["Quantity"] | null;
      /** Highest stretch beyond the nominal length, share of it. */
      max_pretension?: components["schemas"]["Quantity"] | null;
      /** Shortest muscle that is made. */
      min_nominal_length?: components["schemas"]["Quantity"] | null;
      /** Longest muscle that is made. */
      max_nominal_length?: components["schemas"]["Quantity"] | null;
    };
    /** dx/dt = A x + B u, y = C x + D u: deviations from the operating point, in SI. */
    LinearModelAnswer: {
      /** Name. */
      name: string;
      /** What it is a model of. */
      text: string;
      /** Whether loop and design use it. */
      primary: boolean;
      /** Gauge pressure at which it was linearised. [Pa] */
      pressure: number;
      /** Dead time of the command; in gain and phase, not in the matrices. [s] */
      dead_time: number;
      /** States, in the order of the matrices. */
      states: components["schemas"]["NamedValue"][];
      /** Inputs, in the order of the matrices. */
      inputs: components["schemas"]["NamedValue"][];
      /** Outputs, in the order of the matrices. */
      outputs: components["schemas"]["NamedValue"][];
      /** A, one list for each row. */
      a: number[][];
      /** B, one list for each row. */
      b: number[][];
      /** C, one list for each row. */
      c: number[][];
      /** D, one list for each row. */
      d: number[][];
      /** Poles, slowest first. */
      poles: components["schemas"]["Pole"][];
      /** Zeros of the channel that hide no pole. */
      zeros: components["schemas"]["Zero"][];
      /** Gain at 0 Hz in the units of output per input; null where the channel integrates. */
      static_gain: number | null;
      /** Frequency at which the gain has fallen by 3 dB. [Hz] */
      bandwidth: number | null;
      /** Why there is no bandwidth. */
      bandwidth_note: string | null;
      /** Gain over `frequency`, in the units of output per input. */
      gain: (number | null)[];
      /** Phase over `frequency`, with the dead time. [rad] */
      phase: (number | null)[];
    };
    /** Where the drive was linearised. */
    LinearPointAnswer: {
      /** Position of the load. [m] */
      position: number;
      /** Contraction ratio of the (first) muscle. [1] */
      contraction: number;
      /** Gauge pressure in the (first) muscle. [Pa] */
      pressure: number;
      /** Gauge pressure in the second muscle of a pair. [Pa] */
      counter_pressure: number | null;
      /** Command that holds the load there. [1] */
      command: number;
      /** Tension of the (first) muscle. [N] */
      force: number;
      /** External force on the load. [N] */
      load_force: number;
      /** Gauge pressure of the supply. [Pa] */
      supply_pressure: number;
      /** Whether the load rests on an end stop. */
      on_stop: boolean;
    };
    /** The operating point by one value; the others stay null. */
    LinearPointInput: {
      /** Position of the load, positive = muscle shorter. [m] */
      position?: number | string | null;
      /** Contraction ratio of the (first) muscle. [1] */
      contraction?: number | string | null;
      /** Gauge pressure in the (first) muscle. [Pa] */
      pressure?: number | string | null;
      /** Set point of a regulator as a share of its range. [1] */
      command?: number | string | null;
    };
    /** The linear view of a drive at an operating point, in SI; angles in rad. */
    LinearisationAnswer: {
      /** Where it was linearised. */
      point: components["schemas"]["LinearPointAnswer"];
      /** Whether nothing sticks or switches there in a way the motion shows: there is one model. */
      smooth: boolean;
      /** What the linear models do not contain. */
      lost: string[];
      /** Commands between which nothing reacts. [1] */
      dead_band: number[] | null;
      /** Input of the chosen channel. */
      input: components["schemas"]["NamedValue"];
      /** Output of the chosen channel. */
      output: components["schemas"]["NamedValue"];
      /** Frequencies of the models' gain and phase. [Hz] */
      frequency: number[];
      /** One model, or several where something sticks or switches: each names its case. */
      models: components["schemas"]["LinearModelAnswer"][];
      /** The nonlinear drive under sines. */
      describing: components["schemas"]["DescribingPointAnswer"][];
      /** Loop of the drive's controller; null without one. */
      loop: components["schemas"]["LoopAnswer"] | null;
      /** The designed controller; null unless asked for. */
      design: components["schemas"]["mckibben__server__schemas__linearisations__DesignAnswer"] | null;
      /** Remarks. */
      notes: string[];
    };
    /** A drive, an operating point, and what to show of its linear view. */
    LinearisationRequest: {
      /** A drive document, or the id of a drive preset. */
      drive: components["schemas"]["DriveDocument"] | string;
      /** Operating point. Default: the middle of the positions that can be held. */
      at?: components["schemas"]["LinearPointInput"] | null;
      /** Input of responses, poles and zeros: command, supply_pressure or load_force; counter_command of an antagonist pair. */
      input?: string;
      /** Output: position, velocity, pressure, force, mass_flow or position_reading; of an antagonist pair also counter_pressure, counter_force or counter_mass_flow. */
      output?: string;
      /** Amplitudes of sines for the nonlinear drive, in the SI unit of the input. Default: 1, 5 and 20 % of full command or of the tension; an empty list: no sweep. */
      amplitudes?: number[] | null;
      /** Goals of a controller design; null: no design. */
      design?: components["schemas"]["DesignInput"] | null;
    };
    /** One run for the first value of each quantity, one for the second values, and so on. */
    ListMethod: {
      /** Name of the method. */
      type: "list";
    };
    /** The load of the muscle. */
    LoadInput: {
      /** Mass of the load. [kg] */
      mass?: number | string;
      /** External force against the pull: a constant, or a signal of time. [N] */
      force?: number | string | {
        /** Name of the shape. */
        shape: "step";
        /** When it steps. [s] */
        at?: number | string;
        /** The value after the step, inside the pulse, or in the first part of a period. [N] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [N] */
        initial?: number | string;
      } | {
        /** Name of the shape. */
        shape: "pulse";
        /** The value after the step, inside the pulse, or in the first part of a period. [N] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [N] */
        initial?: number | string;
        /** When the pulse begins. [s] */
        on?: number | string;
        /** When the pulse ends. [s] */
        off: number | string;
      } | {
        /** Name of the shape. */
        shape: "square";
        /** The value after the step, inside the pulse, or in the first part of a period. [N] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [N] */
        initial?: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** Share of each period with the first level. [1] */
        duty?: number | string;
        /** Peak to peak, the full height: level - initial. [N] */
        amplitude?: number | string;
      } | {
        /** Name of the shape. */
        shape: "triangle";
        /** Peak to peak, the full height: offset to offset + amplitude. [N] */
        amplitude: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** The value that the amplitude is added to. [N] */
        offset?: number | string;
      } | {
        /** Name of the shape. */
        shape: "ramp";
        /** The value before the ramp. [N] */
        from?: number | string;
        /** The value after the ramp. [N] */
        to: number | string;
        /** When the ramp begins. [s] */
        start?: number | string;
        /** How long the ramp lasts. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "sine";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [N] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [N] */
        offset?: number | string;
        /** Periods per second; or give the period. [Hz] */
        frequency?: number | string;
        /** Angle at t = 0. [rad] */
        phase?: number | string;
        /** Duration of one period. [s] */
        period?: number | string;
      } | {
        /** Name of the shape. */
        shape: "chirp";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [N] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [N] */
        offset?: number | string;
        /** Frequency at the start. [Hz] */
        from: number | string;
        /** Frequency at the end of the duration and after it. [Hz] */
        to: number | string;
        /** How long the frequency changes. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "random";
        /** How long each level lasts. [s] */
        hold: number | string;
        /** Number that the levels follow from; the same seed gives the same levels. */
        seed?: number;
        /** Lowest level. [N] */
        lower?: number | string;
        /** Highest level. [N] */
        upper: number | string;
      } | {
        /** Name of the shape. */
        shape: "table";
        /** Instants of the points, ascending. [s] */
        times: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Values of the points, as many as instants. [N] */
        values: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Joined by lines, or each value held until the next. */
        interpolation?: "linear" | "hold";
      };
      /** Angle between the motion of the load and the horizontal. Default 90 deg. [rad] */
      inclination?: number | string | null;
      /** Hanging is 90 deg, horizontal 0 deg. A lever needs lever_ratio. An antagonist pair needs pulley_radius: a second, equal muscle with the mirrored command pulls in the other direction. */
      arrangement?: "hanging" | "inclined" | "horizontal" | "lever" | "antagonist" | null;
      /** Spring against the contraction, at the load. [N/m] */
      spring?: number | string;
      /** Stroke of the muscle per stroke of the load. [1] */
      lever_ratio?: number | string | null;
      /** Radius of the pulley of an antagonist pair. [m] */
      pulley_radius?: number | string | null;
      /** Contraction of both muscles of a pair in the middle position. Default 10 %. [1] */
      precontraction?: number | string | null;
    };
    /** A lognormal distribution, possibly truncated: its logarithm is normally distributed. */
    LognormalDistribution: {
      /** Kind of distribution. */
      type: "lognormal";
      /** Median, before truncation. */
      median: number | string;
      /** Standard deviation of the natural logarithm; 0.1 is a spread of about 10 %. */
      log_deviation: number;
      /** Values below it do not occur: the distribution is truncated there. Default: not truncated. */
      least?: number | string | null;
      /** Values above it do not occur: the distribution is truncated there. Default: not truncated. */
      most?: number | string | null;
    };
    /** Area of the force residual over a closed path: energy dissipation that the model misses. */
    Loop: {
      /** Number of the sweep or cycle. */
      group: number;
      /** Positive: the model lacks friction. [J] */
      area: number;
      /** Travel between the reversals. [m] */
      span: number;
    };
    /** The loop of the drive's controller with the primary model. */
    LoopAnswer: {
      /** The controller of the drive. */
      controller: components["schemas"]["ControllerAnswer"];
      /** Stability and margins. */
      margins: components["schemas"]["MarginsAnswer"];
      /** Frequencies up to half the sampling frequency. [Hz] */
      frequency: number[];
      /** Gain of the open loop. [1] */
      gain: (number | null)[];
      /** Phase of the open loop. [rad] */
      phase: (number | null)[];
      /** Gain from the reference to the position. [1] */
      closed_gain: (number | null)[];
    };
    /** Stability of the closed loop of the linear model, and how far it is from its limit. */
    MarginsAnswer: {
      /** Whether the sampled closed loop is stable. */
      stable: boolean;
      /** Factor of the gain up to the limit of stability. [1] */
      gain_margin: number | null;
      /** Frequency at which the phase is -180 degrees. [Hz] */
      gain_margin_at: number | null;
      /** Phase left where the gain of the loop is 1. [rad] */
      phase_margin: number | null;
      /** Frequency at which the gain of the loop is 1. [Hz] */
      crossover: number | null;
      /** Further dead time up to the limit of stability. [s] */
      delay_margin: number | null;
      /** Least distance of the open loop from -1. [1] */
      modulus_margin: number;
      /** Frequency at which the closed loop has fallen by 3 dB. [Hz] */
      bandwidth: number | null;
    };
    /** The range of a quantity in the data of a model. */
    MeasuredRange: {
      /** Smallest value. */
      least: number;
      /** Largest value. */
      most: number;
      /** SI unit; pressures are gauge. */
      unit: string;
    };
    /** The range of a quantity in the data of a model. */
    MeasuredSpan: {
      /** Least value, SI. */
      least: number;
      /** Largest value, SI. */
      most: number;
      /** SI unit. */
      unit: string;
    };
    /** A measurement as it was read. */
    MeasurementAnswer: {
      /** SHA-256 of the file's content (and of the mapping, if there is one). */
      id: string;
      /** Name of the file. */
      name: string;
      /** isobaric, isometric, isotonic, diameter, transient or static. */
      kind: string;
      /** Detected from the data, not stated in the file. */
      kind_detected: boolean;
      /** Why this kind was detected; empty when it was stated. */
      kind_reason: string;
      /** Number of rows that were read. */
      rows: number;
      /** Rows with a usable measurement. */
      usable_rows: number;
      /** Reason why rows are not usable -> number of rows. */
      excluded: { [key: string]: number };
      /** Reason why rows could not be read -> number of rows. */
      skipped: { [key: string]: number };
      /** The used columns. */
      channels: components["schemas"]["Channel"][];
      /** Columns that are not used. */
      ignored: string[];
      /** Conditions of the test, SI. */
      conditions: { [key: string]: string | number | null };
      /** Conditions to ask for. */
      missing: components["schemas"]["MissingCondition"][];
      /** Number of sweeps or cycles of the rows. */
      groups: number;
      /** How the rows are divided into sweeps. */
      segments: components["schemas"]["Segmentation"];
      /** Remarks on the file. */
      messages: string[];
      /** All columns that nothing is read from, and why. */
      unread: components["schemas"]["UnreadColumn"][];
      /** The conditions with their origin. */
      stated: components["schemas"]["StatedCondition"][];
      /** What the file leaves open. */
      questions: components["schemas"]["OpenQuestion"][];
    };
    /** Force over pressure and length. */
    MeasurementColumns: {
      /** Gauge pressure. */
      pressure: components["schemas"]["Column"];
      /** Length of the muscle. */
      length: components["schemas"]["Column"];
      /** Force. */
      force: components["schemas"]["Column"];
    };
    /** A measurement with its data. */
    MeasurementDetail: {
      /** SHA-256 of the file's content (and of the mapping, if there is one). */
      id: string;
      /** Name of the file. */
      name: string;
      /** isobaric, isometric, isotonic, diameter, transient or static. */
      kind: string;
      /** Detected from the data, not stated in the file. */
      kind_detected: boolean;
      /** Why this kind was detected; empty when it was stated. */
      kind_reason: string;
      /** Number of rows that were read. */
      rows: number;
      /** Rows with a usable measurement. */
      usable_rows: number;
      /** Reason why rows are not usable -> number of rows. */
      excluded: { [key: string]: number };
      /** Reason why rows could not be read -> number of rows. */
      skipped: { [key: string]: number };
      /** The used columns. */
      channels: components["schemas"]["Channel"][];
      /** Columns that are not used. */
      ignored: string[];
      /** Conditions of the test, SI. */
      conditions: { [key: string]: string | number | null };
      /** Conditions to ask for. */
      missing: components["schemas"]["MissingCondition"][];
      /** Number of sweeps or cycles of the rows. */
      groups: number;
      /** How the rows are divided into sweeps. */
      segments: components["schemas"]["Segmentation"];
      /** Remarks on the file. */
      messages: string[];
      /** All columns that nothing is read from, and why. */
      unread: components["schemas"]["UnreadColumn"][];
      /** The conditions with their origin. */
      stated: components["schemas"]["StatedCondition"][];
      /** What the file leaves open. */
      questions: components["schemas"]["OpenQuestion"][];
      /** Channel -> values in SI; 'slack' marks rows without pulling force, 'usable' those with a usable measurement, 'sweep' and 'cycle' number them, 'motion' is -1 shortening, +1 lengthening, 0 at rest. */
      columns: { [key: string]: (number | boolean | null)[] };
    };
    /** Published measured points; ``slack`` marks rows where the muscle did not pull (not a measured zero). */
    MeasurementPresetAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a measurement. */
      kind: "measurement";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Id of the muscle preset that it belongs to. */
      muscle: string;
      /** The numbers, column by column. */
      data_columns: components["schemas"]["MeasurementColumns"];
      /** Rows that are not used. */
      excluded?: components["schemas"]["Exclusion"][];
      /** Where the numbers come from, in a few words. */
      source: string;
      /** S: read in the cited source; S2: read second-hand; C: computed from cited data; D: derived or fitted for this project; M: general knowledge, not verified; E: engineering estimate, not verified; user: given by the user */
      grade: "S" | "S2" | "C" | "D" | "M" | "E" | "user";
      /** Remark on the numbers. */
      note?: string | null;
      /** How it was measured. */
      measurement_kind: "isobaric" | "isometric" | "isotonic" | "diameter" | "transient" | "static";
      /** Length of the muscle at rest. */
      nominal_length: components["schemas"]["Quantity"];
      /** What was measured. */
      sample: string;
      /** 1 for each row in which the muscle did not pull; empty: it pulled in all. */
      slack?: (0 | 1)[];
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** A condition that a comparison of this kind needs and the file does not state. */
    MissingCondition: {
      /** Name of the condition. */
      key: string;
      /** Its SI unit. */
      unit: string;
      /** What it is needed for. */
      why: string;
      /** An example value. */
      example: string;
      /** Conditions that replace it. */
      alternatives: string[];
    };
    /** The effects used, with all their values in SI. */
    ModelAnswer: {
      /** Effect id -> parameter -> value in SI. */
      effects: { [key: string]: { [key: string]: number } };
    };
    /** A model in the form of a request. */
    ModelJson: {
      /** Effect id -> its parameters, SI. */
      effects: { [key: string]: { [key: string]: number | string } };
    };
    /** Independent random values; ranges are uniform distributions. */
    MonteCarloMethod: {
      /** Name of the method. */
      type: "monte_carlo";
      /** Number of runs. */
      runs?: number;
      /** The random numbers follow from it: the same seed gives the same runs. */
      seed?: number;
    };
    /** Morris' elementary effects: which quantities matter at all, with few runs. */
    MorrisMethod: {
      /** Name of the method. */
      type: "morris";
      /** Trajectories; trajectories * (quantities + 1) runs. */
      trajectories?: number;
      /** Levels of each quantity, an even number. */
      levels?: number;
      /** The random numbers follow from it: the same seed gives the same runs. */
      seed?: number;
    };
    /** A muscle: geometry, limits, catalogue data and the effects its model has by default. Attributes: extrapolated: why its force is not known from a curve or a measurement; None when it is. Sizing ranks such a muscle behind all others. */
    MuscleAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a muscle. */
      kind: "muscle";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Effect id -> parameter -> value: the effects that the model has by default. */
      effects?: { [key: string]: { [key: string]: components["schemas"]["Quantity"] } };
      /** Series of the maker. */
      series?: string;
      /** The muscle at rest. */
      geometry: components["schemas"]["Geometry"];
      /** How far a fit may change the geometry. */
      tolerance?: components["schemas"]["Tolerance"];
      /** Limits stated by the maker. */
      limits?: components["schemas"]["Limits"];
      /** Further catalogue data, by name. */
      data?: { [key: string]: components["schemas"]["Quantity"] };
      /** Id of a curve preset of the maker. */
      reference_curve?: string | null;
      /** Id of a measurement preset of this muscle. */
      measurement?: string | null;
      /** Why its force is not known from a curve or a measurement; null when it is. */
      extrapolated?: string | null;
      /** How its values were fitted to measurements; null where they were not. With it, answers have intervals and say where the muscle was not measured. */
      fit?: components["schemas"]["FitRecord"] | null;
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** The geometry of the muscle at rest in all forms. */
    MuscleGeometry: {
      /** Diameter of the braid at the braid angle. [m] */
      braid_diameter: number;
      /** Angle between thread and axis. [rad] */
      braid_angle: number;
      /** Length at rest. [m] */
      nominal_length: number;
      /** Bore. [m] */
      inside_diameter: number;
      /** Wall of the bladder; 0 when not stated. [m] */
      wall_thickness: number;
      /** Length of one thread. [m] */
      thread_length: number;
      /** Turns of one thread. [1] */
      turns: number;
      /** The lattice, when the muscle was stated in this form. */
      rhombus: components["schemas"]["RhombusAnswer"] | null;
    };
    /** A preset id, or a length with exactly one of: diameter and angle, thread length and turns, rhombus. With a preset, the stated fields override its values. */
    MuscleInput: {
      /** Id of a muscle preset; null: the geometry is stated. */
      preset?: string | null;
      /** Length between the fittings at rest. [m] */
      nominal_length?: number | string | null;
      /** Bore at rest. [m] */
      inside_diameter?: number | string | null;
      /** Diameter of the braid at the braid angle. Default: the inside diameter. [m] */
      braid_diameter?: number | string | null;
      /** Angle between thread and muscle axis at rest. [rad] */
      braid_angle?: number | string | null;
      /** Wall of the bladder at rest. [m] */
      wall_thickness?: number | string | null;
      /** Length of one thread of the braid. [m] */
      thread_length?: number | string | null;
      /** Turns a thread makes around the muscle. [1] */
      turns?: number | string | null;
      /** The lattice of the braid, instead of diameter and angle. */
      rhombus?: components["schemas"]["RhombusInput"] | null;
    };
    /** A muscle: geometry, limits, catalogue data and the effects its model has by default. Attributes: extrapolated: why its force is not known from a curve or a measurement; None when it is. Sizing ranks such a muscle behind all others. */
    MusclePreset: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a muscle. */
      kind: "muscle";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Effect id -> parameter -> value: the effects that the model has by default. */
      effects?: { [key: string]: { [key: string]: components["schemas"]["Quantity"] } };
      /** Series of the maker. */
      series?: string;
      /** The muscle at rest. */
      geometry: components["schemas"]["Geometry"];
      /** How far a fit may change the geometry. */
      tolerance?: components["schemas"]["Tolerance"];
      /** Limits stated by the maker. */
      limits?: components["schemas"]["Limits"];
      /** Further catalogue data, by name. */
      data?: { [key: string]: components["schemas"]["Quantity"] };
      /** Id of a curve preset of the maker. */
      reference_curve?: string | null;
      /** Id of a measurement preset of this muscle. */
      measurement?: string | null;
      /** Why its force is not known from a curve or a measurement; null when it is. */
      extrapolated?: string | null;
      /** How its values were fitted to measurements; null where they were not. With it, answers have intervals and say where the muscle was not measured. */
      fit?: components["schemas"]["FitRecord"] | null;
    };
    /** A measurement to practise on; without the solution. */
    Mystery: {
      /** Its id. */
      id: string;
      /** Its name. */
      title: string;
      /** The situation, as an engineer would describe it. */
      story: string;
      /** Measurement kind. */
      kind: string;
      /** In the form of a comparison request. */
      muscle: { [key: string]: unknown };
      /** In the form of a comparison request; null if not needed. */
      drive: { [key: string]: unknown } | null;
      /** The start model. */
      effects: { [key: string]: { [key: string]: number | string } };
      /** Id of the measurement for comparisons and diagnoses. */
      measurement: string;
    };
    /** A state, an input or an output. */
    NamedValue: {
      /** Name. */
      name: string;
      /** SI unit. */
      unit: string;
      /** What it is. */
      text: string;
      /** Value at the operating point, in its unit; states of gas absolute. */
      value: number;
    };
    /** A project to be kept. */
    NewProject: {
      /** Title, in one line, at most 200 characters. */
      title: string;
      /** Notes of the user, plain text. */
      notes?: string;
      /** The document: any JSON object. Measurements whose ids stand anywhere in it are kept with it. */
      document: { [key: string]: unknown };
      /** The study of the document, as for /api/studies: its runs that the server keeps, up to 20 MB, are kept with the project. One that cannot be used is passed over. null: study tables stay. */
      study?: { [key: string]: unknown } | null;
    };
    /** The experiment that splits a group of indistinguishable effects best, with its set points. */
    NextExperiment: {
      /** The effects, that of the model first. */
      group: string[];
      /** How to do it, in words. */
      protocol: string;
      /** How long it takes. */
      minutes: number;
      /** How well it tells each pair of the group apart. */
      separations: components["schemas"]["PairSeparation"][];
      /** Number of the run of each set point; time starts anew in each. */
      run: number[];
      /** Linear between the rows. */
      set_points: { [key: string]: components["schemas"]["SetPoints"] };
    };
    /** The error due to noise; a smaller one cannot be reached. */
    NoiseFloor: {
      /** The error; null where it cannot be estimated. */
      rmse: number | null;
      /** How it was estimated. */
      how: string;
      /** From the scatter of neighbouring readings to all that no variable explains; null where a structure remains. */
      interval: number[] | null;
    };
    /** A normal distribution, possibly truncated. */
    NormalDistribution: {
      /** Kind of distribution. */
      type: "normal";
      /** Mean, before truncation. */
      mean: number | string;
      /** Standard deviation, before truncation. */
      deviation: number | string;
      /** Values below it do not occur: the distribution is truncated there. Default: not truncated. */
      least?: number | string | null;
      /** Values above it do not occur: the distribution is truncated there. Default: not truncated. */
      most?: number | string | null;
    };
    /** An effect that these data cannot show, or that the request excludes. */
    NotTried: {
      /** Its id. */
      effect: string;
      /** The reason. */
      why: string;
      /** Whether the time of each row would make it a candidate. */
      needs_time: boolean;
    };
    /** What the file leaves open. */
    OpenQuestion: {
      /** What it is about. */
      about: string;
      /** The question. */
      text: string;
      /** What answers it, in the words of the command line and of a mapping. */
      option: string;
      /** The column concerned. */
      column: string | null;
      /** The likeliest answer. */
      proposed: string | null;
      /** Possible answers. */
      choices: string[];
      /** Without an answer the file is not read. */
      stops: boolean;
    };
    /** The state in which the muscle holds the load at one pressure. */
    OperatingPoint: {
      /** Gauge pressure. [Pa] */
      pressure: number;
      /** Contraction; null when out of reach. [1] */
      contraction: number | null;
      /** Length; null when out of reach. [m] */
      length: number | null;
      /** The load. [N] */
      force: number | null;
      /** Stiffness at constant pressure. [N/m] */
      stiffness: number | null;
      /** Stiffness with the valve closed. [N/m] */
      stiffness_closed: number | null;
      /** Braid diameter. [m] */
      diameter: number | null;
      /** Codes of the flags of this point. */
      flags: string[];
    };
    /** Optimisation of one or several goals within limits, over the ranges of the quantities. */
    OptimisationMethod: {
      /** Name of the method. */
      type: "optimisation";
      /** Runs of a generation. */
      population?: number;
      /** Number of generations. */
      generations?: number;
      /** The random numbers follow from it: the same seed gives the same runs. */
      seed?: number;
    };
    /** What an order code says. */
    OrderCodeAnswer: {
      /** As it was given. */
      code: string;
      /** Id of the muscle preset of its series and diameter. */
      preset: string;
      /** Length that it states [m]. */
      nominal_length: number;
      /** Its parts, and what each means. */
      parts: components["schemas"]["CodePartAnswer"][];
    };
    /** Characteristics over pressure: position at the load, force and diameters at the fixed length. */
    OverPressure: {
      /** Gauge pressure. [Pa] */
      pressure: number[];
      /** The load. [N] */
      load: number | null;
      /** While shortening; null without a load. */
      filling: components["schemas"]["OverPressureBranch"] | null;
      /** While lengthening; null without a load. */
      venting: components["schemas"]["OverPressureBranch"] | null;
      /** The fixed length. [m] */
      fixed_length: number | null;
      /** Force over pressure; null without a fixed length. */
      force_at_fixed_length: components["schemas"]["ForceAtLength"] | null;
      /** Braid diameter; null without a fixed length. [m] */
      diameter_at_fixed_length: (number | null)[] | null;
      /** Outer diameter of the wall; null without a fixed length. [m] */
      outer_diameter_at_fixed_length: (number | null)[] | null;
      /** Width of the loop; null without a load. */
      loop?: components["schemas"]["HysteresisLoop"] | null;
    };
    /** Position over pressure in one direction of motion; null where the muscle cannot carry the load. */
    OverPressureBranch: {
      /** Contraction at the load. [1] */
      contraction: (number | null)[];
      /** Length at the load. [m] */
      length: (number | null)[];
      /** Braid diameter at the load. [m] */
      diameter: (number | null)[];
      /** Outer diameter of the wall at the load. [m] */
      outer_diameter: (number | null)[];
    };
    /** A step of the reference, and its overshoot. */
    Overshoot: {
      /** When. [s] */
      time: number;
      /** Signed height of the step. [m] */
      size: number;
      /** Overshoot as a share of the height. [1] */
      overshoot: number;
    };
    /** Two equal muscles that pull a pulley in opposite directions. */
    PairInput: {
      /** Total angle, from one end to the other. [rad] */
      angle: number | string;
      /** Torque against the first muscle, over the whole angle. 0 = no torque. [N*m] */
      torque?: number | string;
      /** Moment of inertia of all rotating parts. 0 = no inertia. [kg*m^2] */
      inertia?: number | string;
      /** Radius of the pulley. Default: eight radii from 10 to 120 mm are tried. [m] */
      pulley_radius?: number | string | null;
    };
    /** By how many standard deviations of one reading an experiment tells two effects apart. */
    PairSeparation: {
      /** Ids of the two effects. */
      pair: string[];
      /** The number of standard deviations. */
      separation: number;
    };
    /** Published figures of a drive. Attributes: figure: number of the figure. figures: "extend.rise_time" -> value; names of the timing table, or explained in the description. tolerance: permitted relative deviation of a figure, by the same names. excluded: reason why a figure is not compared, by the same names. */
    PaperFigures: {
      /** Number of the figure. */
      figure: string;
      /** Figure of the timing table, as extend.rise_time -> published value. */
      figures?: { [key: string]: components["schemas"]["Quantity"] };
      /** Permitted relative deviation of a figure, by the same names. */
      tolerance?: { [key: string]: number };
      /** Why a figure is not compared, by the same names. */
      excluded?: { [key: string]: string };
    };
    /** The error after adding an effect; first the start model as given, then its own numbers refitted. */
    PathStep: {
      /** The added effect; null in the steps of the start model. */
      added: string | null;
      /** The start model with its own numbers fitted, before any effect. */
      refitted: boolean;
      /** The added effect is kept, but not called missing. */
      correction: boolean;
      /** Root mean square of the residual. */
      rmse: number;
      /** RMSE with whole groups left out of the fit. */
      holdout_rmse: number;
      /** The model after the step. */
      model: components["schemas"]["ModelJson"];
      /** Constants fitted as well, as effect.parameter. */
      freed: string[];
      /** Number of fitted values; with 0 no group was left out of anything. */
      fitted: number;
    };
    /** A pole; of a complex pair the one with the positive imaginary part. */
    Pole: {
      /** Real part. [rad/s] */
      real: number;
      /** Imaginary part. [rad/s] */
      imaginary: number;
      /** Magnitude. [Hz] */
      frequency: number;
      /** Damping ratio; null for an integrator. [1] */
      damping: number | null;
      /** Time constant of the decay; null where nothing decays. [s] */
      time_constant: number | null;
      /** Kind of motion. */
      kind: "integrator" | "real" | "oscillation" | "unstable";
      /** Whether a zero hides it in the chosen channel. */
      cancelled: boolean;
    };
    /** Where new readings of the position are expected, where the model was measured; wider elsewhere. */
    PositionInterval: {
      /** Lower ends. [m] */
      low: (number | null)[];
      /** Upper ends. [m] */
      high: (number | null)[];
      /** Share of the readings between them. [1] */
      share: number;
    };
    /** A preset file that was not loaded, and why. */
    PresetProblem: {
      /** Name of the file. */
      file: string;
      /** Where in the file. */
      field: string | null;
      /** What is wrong with it. */
      message: string;
      /** What would be right. */
      hint: string | null;
    };
    /** All presets of one kind, and the files that could not be loaded. */
    PresetsAnswer: {
      /** The requested kind. */
      kind: "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks";
      /** The presets, by id. */
      presets: (components["schemas"]["MuscleAnswer"] | components["schemas"]["ValveAnswer"] | components["schemas"]["TubeAnswer"] | components["schemas"]["FittingAnswer"] | components["schemas"]["MeasurementPresetAnswer"] | components["schemas"]["CurvePresetAnswer"] | components["schemas"]["mckibben__server__schemas__presets__DesignAnswer"] | components["schemas"]["DriveAnswer"] | components["schemas"]["TaskAnswer"])[];
      /** Preset files that could not be loaded. */
      problems: components["schemas"]["PresetProblem"][];
    };
    /** The pressure for a force at a length or contraction. */
    PressureQuestion: {
      /** The muscle. */
      muscle: components["schemas"]["MuscleInput"];
      /** The effects of its model; null: those of the preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Temperature of the muscle. [K] */
      temperature?: number | string;
      /** Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none. */
      direction?: -1 | 0 | 1;
      /** Asks for a pressure. */
      question: "pressure";
      /** The required force. [N] */
      force: number | string;
      /** The length; or give the contraction. [m] */
      length?: number | string | null;
      /** The contraction; or give the length. [1] */
      contraction?: number | string | null;
    };
    /** How a file would be read; nothing is stored. */
    PreviewAnswer: {
      /** Name of the file. */
      name: string;
      /** csv, json, xlsx, mat, hdf5 or tdms. */
      format: string;
      /** All columns of the file, in its order. */
      columns: components["schemas"]["PreviewColumn"][];
      /** The first rows as written in the file, up to 8. */
      sample: string[][];
      /** Rows below the header. */
      rows: number;
      /** Rows that can be read. */
      valid_rows: number;
      /** Rows that cannot be read, by reason. */
      skipped: components["schemas"]["SkippedRows"][];
      /** The kind; null while the file cannot be used. */
      kind: string | null;
      /** Detected from the data, not stated in the file. */
      kind_detected: boolean;
      /** Why this kind was detected; empty when it was stated. */
      kind_reason: string;
      /** Conditions in the file or in the mapping, SI. */
      conditions: { [key: string]: string | number | null };
      /** Conditions to ask for. */
      missing: components["schemas"]["MissingCondition"][];
      /** As it would be stored, without the skipped rows; null while the file cannot be used. */
      measurement: components["schemas"]["MeasurementAnswer"] | null;
      /** The error with which PUT would refuse the file. */
      problem: components["schemas"]["ErrorDetail"] | null;
      /** The only problem are bad rows: the mapping {'bad_rows': 'skip'} leaves them out. */
      only_bad_rows: boolean;
      /** Assumptions made. */
      messages: string[];
      /** Channels to which a column can be mapped. */
      channel_choices: components["schemas"]["ChannelChoice"][];
      /** Kinds that a mapping may state. */
      kind_choices: string[];
      /** What the file leaves open; 'problem' refuses it while one of them stops the reading. */
      questions: components["schemas"]["OpenQuestion"][];
      /** All columns that nothing is read from, and why. */
      unread: components["schemas"]["UnreadColumn"][];
      /** The conditions with their origin. */
      stated: components["schemas"]["StatedCondition"][];
      /** Sheets, groups or structs that could be meant; 'sheet' of a mapping picks one. */
      table_choices: string[];
      /** All sheets, groups or structs that 'sheet' of a mapping picks; empty where none are. */
      tables: components["schemas"]["TableOption"][];
      /** The first rows as they stand in the file; null where the format has no rows. */
      raw: components["schemas"]["RawTable"] | null;
      /** Channel -> SI values of evenly chosen rows, for a picture, also while questions are open */
      points: { [key: string]: (number | null)[] };
      /** Every field of the experiment that matters for this kind of test; those 'unanswered' are asked before the first diagnosis. */
      experiment: components["schemas"]["ExperimentField"][];
    };
    /** One column of the file, used or not. */
    PreviewColumn: {
      /** Header of the file; the key of a mapping. */
      header: string;
      /** The guessed or chosen channel; null = not used. */
      channel: string | null;
      /** The guessed, given or chosen unit; null = not used. */
      unit: string | null;
      /** The unit is stated in the header or was chosen, not guessed. */
      unit_given: boolean;
      /** An absolute pressure; null = not stated, gauge is assumed. */
      absolute: boolean | null;
      /** Smallest value of the channel, SI. */
      minimum: number | null;
      /** Largest value of the channel, SI. */
      maximum: number | null;
      /** Why the column cannot be used as its header states. */
      why: string | null;
      /** Who says the unit: file, you, proposed from the range, or assumed; null = not used. */
      unit_origin: string | null;
      /** Where the unit stands, apart from the header. */
      unit_where: string | null;
      /** -1: the file counts it the other way. */
      sign: number;
      /** Why nothing is read from the column; null = it is used. */
      unread: string | null;
      /** Its cell in the rows of 'raw', from 0; null = it stands in none. */
      place: number | null;
    };
    /** A project with the document of one version. */
    ProjectAnswer: {
      /** The project as it is now. */
      project: components["schemas"]["ProjectInfo"];
      /** The version of the document. */
      revision: components["schemas"]["RevisionInfo"];
      /** The document as it was saved. */
      document: { [key: string]: unknown };
      /** Ids of the measurements kept with it. */
      measurements: string[];
      /** Number of study tables kept with it. */
      studies: number;
      /** Study tables that are not kept or not shown, and why, in words. */
      remarks: string[];
    };
    /** Another title or other notes. */
    ProjectChange: {
      /** Version that the change began with; 409 where the project has a later one. */
      base_version: number;
      /** New title; null = as it is. */
      title?: string | null;
      /** New notes; null = as they are. */
      notes?: string | null;
    };
    /** How a copy is called. */
    ProjectCopy: {
      /** Title; null = that of the original with "(copy)". */
      title?: string | null;
    };
    /** A project in a list. */
    ProjectInfo: {
      /** Its id. */
      id: string;
      /** Title, in one line, at most 200 characters. */
      title: string;
      /** Notes of the user, plain text. */
      notes: string;
      /** Number of the last version. */
      version: number;
      /** Instant, seconds since 1970 (UTC). */
      created: number;
      /** Instant of the last change, seconds since 1970 (UTC). */
      changed: number;
      /** Instant when it was deleted; null = it is not in the bin. */
      deleted: number | null;
      /** Number of measurements kept with it. */
      files: number;
      /** Size of document, measurements and study tables in bytes. */
      size: number;
    };
    /** A further state of a project. */
    ProjectState: {
      /** The document: any JSON object. Measurements whose ids stand anywhere in it are kept with it. */
      document: { [key: string]: unknown };
      /** The study of the document, as for /api/studies: its runs that the server keeps, up to 20 MB, are kept with the project. One that cannot be used is passed over. null: study tables stay. */
      study?: { [key: string]: unknown } | null;
      /** Version that the change began with; 409 where the project has a later one. */
      base_version: number;
      /** What was done, in words, for the history. */
      label?: string;
      /** Saved without being asked for: such states replace each other within five minutes. */
      automatic?: boolean;
    };
    /** The projects, the one changed last first. */
    ProjectsAnswer: {
      /** The projects. */
      projects: components["schemas"]["ProjectInfo"][];
      /** The database they are in, without a password. */
      place: string;
    };
    /** A drive that fulfils the task. Figures are per muscle unless stated otherwise. */
    ProposalAnswer: {
      /** Id of the preset. */
      muscle: string;
      /** Nominal length of each muscle. [m] */
      nominal_length: number;
      /** Number of parallel muscles (on each side of a pair). */
      parallel: number;
      /** Number of all muscles of the drive. */
      muscles: number;
      /** Id of the preset; one for all parallel muscles, one on each side of a pair. */
      valve: string;
      /** Id of the preset; one tube from the valve to each muscle. */
      tube: string | null;
      /** Length of the tube; 0 without one. [m] */
      tube_length: number;
      /** Pulley radius of a pair. [m] */
      pulley_radius: number | null;
      /** Gauge pressure of the supply at the valve, set by a regulator. [Pa] */
      pressure: number;
      /** Time for the stroke to the end stop. [s] */
      time: number;
      /** Time for the return; null if not reached in the simulated time. [s] */
      time_down: number | null;
      /** Contraction ratio at the end of the stroke. [1] */
      contraction: number;
      /** Least share by which the static force exceeds the load. [1] */
      force_reserve: number;
      /** Pressure that just carries the load at the end of the stroke. [Pa] */
      needed_pressure: number | null;
      /** Pressure in the muscle when the load leaves its stop. [Pa] */
      pressure_start: number;
      /** Pressure in the muscle on arrival. [Pa] */
      pressure_end: number;
      /** Air of all muscles per cycle at ANR. [m^3] */
      air_volume_anr: number;
      /** Cost of the air of a cycle, in the currency of the task. */
      air_cost: number;
      /** Cost of the air of a year, in the currency of the task. */
      air_cost_year: number;
      /** Kinetic energy of the whole load at the end stop. [J] */
      impact_energy: number;
      /** Speed of the load there. [m/s] */
      end_speed: number;
      /** Largest speed of the load. [m/s] */
      max_speed: number;
      /** Largest tension of a muscle. [N] */
      peak_force: number;
      /** Stiffness at the load at the end of the stroke, valve open. [N/m] */
      stiffness: number;
      /** The same with the valve closed. [N/m] */
      stiffness_closed: number;
      /** Nominal length and end fittings. [m] */
      installed_length: number;
      /** Outside diameter at the end of the stroke. [m] */
      diameter: number;
      /** Load cycles; an estimate, not verified. [1] */
      life: number;
      /** Probability that a built drive fulfils the task; null without specimens. [1] */
      probability: number | null;
      /** Its standard error. [1] */
      probability_error: number | null;
      /** Number of specimens simulated for it. */
      specimens: number;
      /** Limit -> margin as a share of the limit; limits that are not set are left out. */
      margins: { [key: string]: number };
      /** The limit with the least margin. */
      binding: "length" | "pressure" | "contraction" | "force" | "force_limit" | "diameter" | "stiffness" | "life" | "temperature" | "time" | "time_down" | "cycle_time" | "suspended_mass" | "valve_pressure";
      /** What costs it rank: margins below 5 %, an impact above limits.max_impact_energy. */
      reservations: string[];
      /** Explanation of its rank. */
      reason: string;
      /** On the Pareto front of the proposals. */
      front: boolean;
      /** Remarks for building it. */
      notes: string[];
      /** Unverified figures it depends on, by preset. */
      unverified: string[];
      /** Drive document for /api/simulations, of one of the muscles. */
      drive: { [key: string]: unknown };
    };
    /** A short formula for a residual that no catalogued effect explains, proven on groups left out. */
    ProposedTerm: {
      /** The formula, as a custom effect takes it. */
      formula: string;
      /** Its constants, SI. */
      coefficients: { [key: string]: number };
      /** Share of the residual's mean square that it removes. */
      share: number;
      /** The model with the term. */
      model: components["schemas"]["ModelJson"];
      /** The term and the residual. */
      curve: components["schemas"]["TermCurve"];
    };
    /** Pulse-width modulation of switching valves. The command is read at the start of each period of a carrier; each valve is then open for its share of the period. */
    PwmInput: {
      /** Frequency of the carrier. [Hz] */
      frequency: number | string;
      /** two: a valve fills while the command is positive and another one vents while it is negative, each for the share |u| of the period; between, both are closed. one: a valve with three ports fills for the share (1 + u)/2 and vents for the rest. */
      valves?: "two" | "one";
      /** Shortest time a valve is open; shorter pulses are left out. Default: 0. [s] */
      min_on?: number | string | null;
      /** Shortest time a valve is closed; shorter pauses are left out. Default: 0. [s] */
      min_off?: number | string | null;
    };
    /** A value with its unit (text), source (short) and grade (a key of `physics.parameter.GRADES`). */
    Quantity: {
      /** The number, in its unit. */
      value: number;
      /** The unit, as a text. */
      unit: string;
      /** Where the value comes from, in a few words. */
      source: string;
      /** S: read in the cited source; S2: read second-hand; C: computed from cited data; D: derived or fitted for this project; M: general knowledge, not verified; E: engineering estimate, not verified; user: given by the user */
      grade: "S" | "S2" | "C" | "D" | "M" | "E" | "user";
      /** Remark on the value. */
      note?: string | null;
    };
    /** A quick exhaust valve on the muscle. As soon as the pressure in the tube is below that in the muscle, the muscle vents through it to the surroundings, and not back through tube and valve. It needs a tube. */
    QuickExhaustInput: {
      /** Conductance of its exhaust, ISO 6358. [m^3/(s*Pa)] */
      sonic_conductance: number | string;
      /** Critical pressure ratio b of its exhaust. Default: 0.3. [1] */
      critical_pressure_ratio?: number | string | null;
      /** Pressure difference between muscle and tube at which it is fully open. Default: 0.1 bar, an estimate. [Pa] */
      band?: number | string | null;
    };
    /** The range of a quantity in the data of the model. */
    RangeInput: {
      /** Smallest value. */
      least: number;
      /** Largest value. */
      most: number;
      /** SI unit. */
      unit: string;
    };
    /** A row of a file. */
    RawRow: {
      /** Its number in the file, from 1. */
      row: number;
      /** Its cells as written. */
      cells: string[];
    };
    /** The first rows of a file as they stand in it; where the head is far down, rows between are left out. */
    RawTable: {
      /** The rows, in the order of the file. */
      rows: components["schemas"]["RawRow"][];
      /** The row of the column names. */
      head: number | null;
      /** The row of the units, where they stand apart. */
      units: number | null;
      /** 'head' of a mapping may name another row. */
      head_moves: boolean;
      /** Cells, from 0, that hold the same columns again beside the first ones. */
      also: number[];
    };
    /** Sensor readings. */
    Readings: {
      /** Gauge pressure. [Pa] */
      pressure: (number | null)[];
      /** Force. [N] */
      force: (number | null)[];
      /** Position of the load. [m] */
      position: (number | null)[];
    };
    /** Makes the valve a pressure regulator: two orifices, of filling and venting, that open with the difference between its set point and the pressure at its outlet. A regulator preset has its own values. */
    RegulatorInput: {
      /** Gauge pressure at full command. [Pa] */
      range?: number | string | null;
      /** Time constant with which the regulator follows its set point; with a damping, that of a lag of second order, 1/(2 pi f). [s] */
      time?: number | string | null;
      /** Damping ratio of a lag of second order. Default: that of the preset, else first order. [1] */
      damping?: number | string | null;
      /** Pressure error at which an orifice of the regulator is fully open. Default: that of the preset, else 5 % of the range, an estimate. [Pa] */
      band?: number | string | null;
      /** Width of the pressure error in which both orifices stay closed. Default: that of the preset, else 0. [Pa] */
      dead_band?: number | string | null;
    };
    /** Figures of a pressure regulator. */
    RegulatorPart: {
      /** Gauge pressure at full command. */
      range: components["schemas"]["Quantity"];
      /** Time constant with which it follows its set point. */
      time: components["schemas"]["Quantity"];
      /** Damping ratio of a lag of second order; null: first order. */
      damping?: components["schemas"]["Quantity"] | null;
      /** Pressure error at which an orifice is fully open. */
      band?: components["schemas"]["Quantity"] | null;
      /** Width of the pressure error in which both orifices are closed. */
      dead_band?: components["schemas"]["Quantity"] | null;
    };
    /** A rejected candidate. */
    RejectedAnswer: {
      /** Id of the preset. */
      muscle: string;
      /** Number of parallel muscles. */
      parallel: number;
      /** Null = with any valve. */
      valve: string | null;
      /** Null = with any tube. */
      tube: string | null;
      /** The reason, with figures. */
      why: string;
      /** The limit that must move by the least share when no other moves. */
      binding: "length" | "pressure" | "contraction" | "force" | "force_limit" | "diameter" | "stiffness" | "life" | "temperature" | "time" | "time_down" | "cycle_time" | "suspended_mass" | "valve_pressure";
      /** What would help, least change first. */
      would_work_if: string;
      /** Number of combinations this entry covers. */
      combinations: number;
    };
    /** A new name. */
    RenameRequest: {
      /** The new name. */
      name: string;
      /** The name that the user saw; refused if it is another by now. */
      was?: string | null;
    };
    /** A periodic part of the unexplained residual. */
    Repetition: {
      /** What it repeats over. */
      over: "length" | "pressure" | "time";
      /** Unit of the period. */
      unit: "m" | "Pa" | "s";
      /** The period. */
      period: number;
      /** Share of the mean square of the residual that it explains. */
      share: number;
      /** Of the predicted channel, in its unit; at the mean pressure where it grows with it. */
      amplitude: number;
      /** Whether its amplitude is in proportion to the pressure. */
      grows_with_pressure: boolean;
      /** Chance that noise does as well somewhere among all periods tried; below 1e-4. */
      false_alarm: number;
      /** The share that it explains of sweeps it was not fitted to. */
      left_out_share: number;
      /** Number of records, or of sweeps. */
      parts: number;
      /** Number of those that a fit to the others explains. */
      shown: number;
      /** What the parts are. */
      parts_are: "records" | "sweeps";
      /** What these data cannot tell it from. */
      also: components["schemas"]["SamePeriod"][];
      /** All of it in words. */
      text: string;
    };
    /** A comparison request, with further content of the report. */
    ReportRequest: {
      /** Null: the drive's. */
      muscle?: components["schemas"]["MuscleInput"] | null;
      /** The effects of the model; null: the drive's, or those of the muscle preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Valve, tube, supply and load of transient measurements with a command channel; the measured command replaces the one stated here. */
      drive?: components["schemas"]["DriveDocument"] | null;
      /** One measurement to fit to. */
      measurement?: string | null;
      /** Measurements to fit to or to validate with, instead of 'measurement'. */
      measurements?: components["schemas"]["UsedMeasurement"][];
      /** Geometry to fit as well, within its tolerance. */
      free?: ("nominal_length" | "braid_diameter" | "braid_angle" | "wall_thickness" | "inside_diameter")[];
      /** Additional parameters to fit, as effect.parameter. */
      freed?: string[];
      /** Standard deviation of the predicted channel, when it is known: a number above 0 in SI, or a text with a unit. */
      noise?: number | string | null;
      /** For every measurement that does not say it in its own 'experiment'. */
      experiment?: components["schemas"]["ExperimentInput"] | null;
      /** Standard deviation of each channel of all measurements (% of the largest value), or sensors: 'length steel rule'. */
      accuracy?: string | null;
      /** Refuse instead of assuming what nobody said. */
      strict?: boolean;
      /** Entries of a diagnosis's 'context' that are wrong as stated: the channel is read in the other way, a quantity is fitted in diagnoses and fits. */
      use?: string[];
      /** Entries of 'context' that are right as stated. */
      keep?: string[];
      /** Fit the effects' parameters to the data. */
      fit?: boolean;
      /** Oldest first. */
      history?: components["schemas"]["HistoryStep"][];
      /** Empty = names of the measurements. */
      title?: string;
      /** Include a diagnosis; takes some seconds. */
      diagnose?: boolean;
    };
    /** A part of the squared residual; the shares of all parts add up to 1. */
    ResidualPart: {
      /** 'offset', a variable, 'together' (several variables) or 'rest': what follows none. */
      of: string;
      /** 0 to 1; each part has only what the ones before it left. */
      share: number;
    };
    /** The residual over one variable. */
    ResidualProfile: {
      /** The variable. */
      over: string;
      /** Share of its mean square explained by this variable. */
      share_explained: number;
      /** The range with the largest error. */
      worst: string;
      /** Error in that range. */
      rmse: number;
      /** Boundaries of the ranges, SI; one more than ranges. */
      edges: (number | null)[];
      /** Mean residual of each range, SI. */
      mean: (number | null)[];
      /** Root mean square of the residual of each range, SI. */
      rms: (number | null)[];
      /** Number of points of each range. */
      count: number[];
    };
    /** The hidden effects, compared with the user's diagnosis. */
    RevealAnswer: {
      /** The hidden effects; none if the start model explains the data. */
      hidden: components["schemas"]["Hidden"][];
      /** For each hidden effect: whether the user named it. */
      found: boolean[];
      /** Effects of the user that are neither hidden nor of the start model. */
      surplus: string[];
      /** The solution in words. */
      text: string;
    };
    /** The user's diagnosis. */
    RevealRequest: {
      /** Ids of the effects of the user's model. */
      effects?: string[];
    };
    /** A version in the history of a project. */
    RevisionInfo: {
      /** Its number. */
      version: number;
      /** Instant, seconds since 1970 (UTC). */
      saved: number;
      /** What was done, in words, for the history. */
      label: string;
      /** Whether it was saved without being asked for. */
      automatic: boolean;
    };
    /** The lattice of the braid. */
    RhombusAnswer: {
      /** Side of one rhombus. [m] */
      side: number;
      /** Rhombi along the muscle. [1] */
      along: number;
      /** Rhombi around the muscle. [1] */
      around: number;
    };
    /** The lattice of the braid: side of the rhombi, and their numbers along and around the muscle. */
    RhombusInput: {
      /** Side of one rhombus. [m] */
      side: number | string;
      /** Rhombi along the muscle. [1] */
      along: number | string;
      /** Rhombi around the muscle. [1] */
      around: number | string;
    };
    /** Probability that built specimens of each design keep the limits. Quantities with values or a range are those of the design (all combinations); quantities with a distribution differ between specimens. All designs are built with the same specimens. */
    RobustMethod: {
      /** Name of the method. */
      type: "robust";
      /** Specimens of each design. */
      runs?: number;
      /** The random numbers follow from it: the same seed gives the same runs. */
      seed?: number;
    };
    /** A period over another coordinate that the data cannot tell from the repetition. */
    SamePeriod: {
      /** The coordinate. */
      over: "length" | "pressure" | "time";
      /** In m, Pa or s. */
      period: number;
    };
    /** A model with its values: a muscle with its fitted geometry, effects, and of a transient the drive. */
    SavedModel: {
      /** Version of the document. */
      schema: 1;
      /** The word 'model'. */
      kind: "model";
      /** Without a length where the model is one of muscles of several lengths. */
      muscle: components["schemas"]["MuscleInput"];
      /** Its effects with their numbers. */
      effects: { [key: string]: { [key: string]: number | string } };
      /** Constants that the fit changed as well, as effect.parameter. */
      freed?: string[];
      /** Geometry that the fit changed as well. */
      free?: string[];
      /** What was stated for that geometry instead, SI. */
      stated?: { [key: string]: number };
      /** Load of isotonic data that do not state it, as the fit found it [N]. */
      load_force?: number | null;
      /** Of a transient: valve, tube, supply, load, stops, with muscle and effects. */
      drive?: components["schemas"]["DriveDocument"] | null;
      /** Quantity -> range in which the model was measured. */
      envelope?: { [key: string]: components["schemas"]["RangeInput"] };
      /** Predicted channel -> error left (rms), SI. */
      errors?: { [key: string]: number };
      /** Of the fitted values; null where the data cannot separate them. */
      covariance?: components["schemas"]["Covariance"] | null;
      /** What nobody said and was assumed. */
      assumed?: string[];
      /** Where it comes from; null where nothing is known. */
      origin?: components["schemas"]["SavedOrigin"] | null;
    };
    /** Where the model comes from. */
    SavedOrigin: {
      /** Name and version. */
      program: string;
      /** Date and time, ISO 8601, UTC. */
      made: string;
      /** Kind of the measurements. */
      kind: string;
      /** Channel that the model predicts. */
      predicted: string;
      /** Title of the verdict. */
      verdict: string;
      /** How well it describes them. */
      error: components["schemas"]["FitError"];
      /** What it was fitted to. */
      files: components["schemas"]["FittedFile"][];
    };
    /** Division of the rows into sweeps. */
    Segmentation: {
      /** The channel that defines the sweeps. */
      signal: string;
      /** Number of sweeps. */
      sweeps: number;
      /** Number of cycles. */
      cycles: number;
      /** Rows in which nothing moves. */
      held_rows: number;
      /** Mean speed of each level, ascending [SI unit of the signal per s]; empty without time. */
      speeds: (number | null)[];
    };
    /** Values of one set point, in its SI unit. */
    SetPoints: {
      /** The SI unit. */
      unit: string;
      /** One value per row. */
      values: (number | null)[];
    };
    /** How the effect shows in the residual. */
    Signature: {
      /** In words. */
      text: string;
      /** Parity when the motion reverses: even, odd or null. */
      direction: string | null;
      /** n when it grows with the n-th power of pressure. */
      pressure_power: number | null;
      /** States in which it contributes nothing. */
      zero_at: string[];
      /** conservative, dissipative, lumped or reading. */
      energy: string;
    };
    /** The pictures of an effect, each computed by the model of the muscle with and without it. */
    SignatureAnswer: {
      /** Id of the effect. */
      effect: string;
      /** All its parameters in SI. */
      values: { [key: string]: number };
      /** One for each kind of test that shows it. */
      pictures: components["schemas"]["SignaturePictureAnswer"][];
      /** Kinds it names, but whose prediction does not contain it. */
      hidden: string[];
      /** Effects in both models, because it only changes what they do. */
      acts_on: string[];
      /** Temperature of the tests [K]. */
      temperature: number;
      /** Largest gauge pressure of the tests [Pa]. */
      pressure: number;
    };
    /** The residual of one run, in the order of its motion. */
    SignatureCurveAnswer: {
      /** What the rig held: pressure, length or load; null in a drive. */
      level: number | null;
      /** What moved. */
      x: number[];
      /** The residual: with the effect minus without it. */
      y: number[];
    };
    /** What the effect leaves in one kind of test; SI. */
    SignaturePictureAnswer: {
      /** Kind of the test. */
      kind: string;
      /** What is predicted: force, length, diameter, stroke or pressure. */
      quantity: string;
      /** Its SI unit. */
      unit: string;
      /** What moves: contraction, pressure or time. */
      x: string;
      /** Its SI unit. */
      x_unit: string;
      /** What the rig holds in each run; empty in a drive. */
      held: string;
      /** Its SI unit. */
      held_unit: string;
      /** One for each run. */
      curves: components["schemas"]["SignatureCurveAnswer"][];
      /** Root mean square of the residual. */
      rms: number;
    };
    /** An effect on a muscle. */
    SignatureRequest: {
      /** The muscle. */
      muscle: components["schemas"]["MuscleInput"];
      /** Id of the effect. */
      effect: string;
      /** Its parameters in SI; missing ones take their usual size. */
      values?: { [key: string]: number };
      /** Largest gauge pressure of the tests; null: the muscle's limit, else 6 bar. [Pa] */
      pressure?: number | string | null;
    };
    /** Columns over time, in SI; pressures gauge; positions, velocities and accelerations positive towards shorter. */
    SimulationAnswer: {
      /** Instants of the rows; fewer than requested if the run ended early. [s] */
      time: number[];
      /** Stroke of the load. [m] */
      position: (number | null)[];
      /** Velocity of the load, positive towards shorter. [m/s] */
      velocity: (number | null)[];
      /** Acceleration of the load, positive towards shorter. [m/s^2] */
      acceleration: (number | null)[];
      /** Pressure in the muscle. [Pa] */
      pressure: (number | null)[];
      /** Tension of the muscle. [N] */
      force: (number | null)[];
      /** Mass flow into the muscle. [kg/s] */
      mass_flow: (number | null)[];
      /** Command before dead times. [1] */
      command: (number | null)[];
      /** Opening of the valve after all effects. [1] */
      opening: (number | null)[];
      /** Set point of the controller. [m] */
      reference: (number | null)[] | null;
      /** Mass flow from the supply. [kg/s] */
      supply_flow: (number | null)[];
      /** Mass flow to the atmosphere. [kg/s] */
      exhaust_flow: (number | null)[];
      /** Pressure in the tube, if there is one. [Pa] */
      tube_pressure: (number | null)[] | null;
      /** Set point of the regulator after its lag, if there is one. [Pa] */
      regulator_pressure: (number | null)[] | null;
      /** Gas volume of the muscle with all dead volumes. [m^3] */
      volume: (number | null)[];
      /** Braid diameter at mid-span. [m] */
      diameter: (number | null)[];
      /** Length of the muscle. [m] */
      length: (number | null)[];
      /** Contraction ratio of the muscle. [1] */
      contraction: (number | null)[];
      /** External force on the load. [N] */
      load_force: (number | null)[];
      /** Temperature of the gas in the muscle. [K] */
      temperature: (number | null)[];
      /** Whether the load rests on an end stop. */
      contact: boolean[];
      /** Whether the muscle hangs slack: it is then longer than its fittings are apart. */
      slack: boolean[];
      /** Where the load is at t = 0, and why there. */
      start: components["schemas"]["StartPosition"];
      /** How the air in the muscle is modelled. */
      gas: string;
      /** Null if no effect changes the sensor readings. */
      readings: components["schemas"]["Readings"] | null;
      /** Joint of an antagonist pair. */
      joint: components["schemas"]["Joint"] | null;
      /** Where new readings of the position are expected; null where the model was not fitted. */
      interval: components["schemas"]["PositionInterval"] | null;
      /** Choked intervals of the whole run, whatever rows are requested. */
      choked: components["schemas"]["Choked"][];
      /** Times, speeds and air of the first fill and the exhaust after it. */
      timing: components["schemas"]["Timing"];
      /** Tracking figures of a controlled run. */
      tracking: components["schemas"]["TrackingAnswer"] | null;
      /** How the run ended; only a completed one has all rows. */
      outcome: "completed" | "stuck" | "diverged" | "timed_out" | "cancelled";
      /** Advice if the run did not complete. */
      message: string | null;
      /** Computing time of the integration in ms. */
      wall_ms: number;
      /** The integrator used. */
      engine: "rodas" | "lsoda";
      /** Steps of the integrator. */
      steps: number;
      /** Remarks on the run. */
      flags: components["schemas"]["Flag"][];
      /** Field -> remark, including those of timing and tracking. */
      notes: { [key: string]: string };
      /** Limits stated by the maker, and the end stops. */
      limits: components["schemas"]["DriveLimits"];
      /** Geometry of the muscle at rest, in all forms. */
      geometry: components["schemas"]["MuscleGeometry"];
      /** The effects used, with all their values. */
      model: components["schemas"]["ModelAnswer"];
      /** Duration of the whole run. [s] */
      duration: number;
    };
    /** A drive, and the part of its run to return. */
    SimulationRequest: {
      /** A drive document, or the id of a drive preset. */
      drive: components["schemas"]["DriveDocument"] | string;
      /** Rows of the answer. */
      points?: number;
      /** First row; 0 when left out. [s] */
      from?: number | string | null;
      /** Last row; the end of the run when left out. [s] */
      to?: number | string | null;
    };
    /** Proposals, best first, and rejected candidates with reasons; SI, pressures gauge. */
    SizingAnswer: {
      /** Best first; empty if no candidate fulfils the task. */
      proposals: components["schemas"]["ProposalAnswer"][];
      /** Why the first comes before the second, in one sentence. */
      ranking: string | null;
      /** Nearest first. */
      rejected: components["schemas"]["RejectedAnswer"][];
      /** The best design of each choice of parts that fulfils the task. */
      explored: components["schemas"]["ExploredDesign"][];
      /** Combinations of muscle, length, number, pressure, valve and tube within the limits. */
      combinations: number;
      /** Number of them ruled out in closed form. */
      pruned: number;
      /** Number of transient runs, without those of specimens. */
      simulated: number;
      /** Number of transient runs for probabilities. */
      specimens: number;
      /** How the search ended; only a completed one has tried everything. */
      outcome: "completed" | "timed_out" | "cancelled";
      /** Advice if the search did not complete. */
      message: string | null;
      /** Remarks on the task. */
      flags: components["schemas"]["Flag"][];
      /** Computing time of the search in ms. */
      wall_ms: number;
    };
    /** The search runs again, so that no figure of the report comes from the caller. */
    SizingReportRequest: {
      /** As for `/api/sizings`. */
      task: components["schemas"]["SizingTask"];
      /** Rank of the proposal, 1 the best. A task without proposals also has a report. */
      proposal?: number;
      /** Empty = title of the task, or a summary of it. */
      title?: string;
    };
    /** A task; only the load, and a stroke or a pair, are required. Plain numbers are in SI units. */
    SizingTask: {
      /** Version of the document. */
      schema?: 1;
      /** Title for display. */
      title?: string;
      /** The load. */
      load: components["schemas"]["TaskLoad"];
      /** Stroke of the load; a pair has an angle instead. [m] */
      stroke?: number | string | null;
      /** Time for the stroke. Leave empty for no limit. [s] */
      time?: number | string | null;
      /** Time for the return stroke. Leave empty for no limit. [s] */
      time_down?: number | string | null;
      /** Time for both strokes together. Leave empty for no limit. [s] */
      cycle_time?: number | string | null;
      /** Average speed of the stroke, instead of the time. [m/s] */
      speed?: number | string | null;
      /** Least stiffness at the load at the end of the stroke with an open valve (with a closed valve it is higher). Leave empty for no limit. [N/m] */
      stiffness?: number | string | null;
      /** Gauge pressure of the supply. Default 6 bar, the limit of most muscles. [Pa] */
      supply_pressure?: number | string;
      /** Ambient temperature. Default 20 °C. [K] */
      ambient_temperature?: number | string;
      /** What a proposed drive may need at most, and its reserves. */
      limits?: components["schemas"]["TaskLimits"];
      /** Parts that may be used. Default: all that are known well enough. */
      catalogue?: components["schemas"]["TaskCatalogue"];
      /** Cycles a year and price of air, for the cost of its air. */
      operation?: components["schemas"]["TaskOperation"];
      /** Expected deviations of real drives, for the probability of success. */
      uncertainty?: components["schemas"]["TaskUncertainty"];
      /** Order of the proposals. Balanced: by air consumption times the square root of installed length and number of muscles. Drives that probably fail come last in any order. */
      rank_by?: "balanced" | "air" | "time" | "length" | "reserve" | "probability";
      /** Most proposals. Default 10. */
      max_proposals?: number;
    };
    /** Rows of the file that cannot be read, for one reason. */
    SkippedRows: {
      /** Why they cannot be read. */
      reason: string;
      /** Number of these rows. */
      rows: number;
      /** Where the first of them is. */
      first: string;
    };
    /** An effect that lowers the error, but not by more than an inexact form of another one explains. */
    SmallCorrection: {
      /** Its id. */
      effect: string;
      /** Error without it. */
      rmse_before: number;
      /** Error with it. */
      rmse_after: number;
      /** That it is missing nevertheless. */
      probability: number;
      /** Whether the model keeps it, because it predicts better with it. */
      kept: boolean;
    };
    /** Sobol's indices: the share of the variance of a figure that each quantity causes. */
    SobolMethod: {
      /** Name of the method. */
      type: "sobol";
      /** Base samples, a power of two; samples * (quantities + 2) runs. */
      samples?: number;
      /** The random numbers follow from it: the same seed gives the same runs. */
      seed?: number;
    };
    /** Source of a figure, and its grade. */
    SourceText: {
      /** Short source. */
      text: string;
      /** S read in the source, S2 second-hand, C computed, D derived here, M general knowledge and E estimate (both unverified), user. */
      grade: string;
    };
    /** One measurement of several. */
    Specimen: {
      /** Name of the file or preset. */
      file: string;
      /** Number of rows used. */
      rows_used: number;
      /** Error of the model on it; of the best model in a diagnosis. */
      rmse: number | null;
      /** The same with whole groups left out of the fit. */
      holdout_rmse: number | null;
      /** Of a diagnosis of several: error of the model fitted to the other specimens alone. */
      left_out_rmse?: number | null;
      /** The same in percent of the largest magnitude measured on it. */
      left_out_percent?: number | null;
      /** Values of its experiment, each with its origin. */
      experiment: { [key: string]: components["schemas"]["ExperimentValue"] };
    };
    /** Where the load is at t = 0. */
    StartInput: {
      /** Position of the load, positive = muscle shorter; released there at t = 0. Default: where it rests at the start pressure; on the lower end stop where it would rest anywhere. [m] */
      position?: number | string | null;
    };
    /** Where the run starts, and why. */
    StartPosition: {
      /** Position of the load at t = 0. [m] */
      position: number;
      /** Contraction of the muscle at t = 0. [1] */
      contraction: number;
      /** Why the run starts there, as a sentence. */
      reason: string;
    };
    /** A condition of the test and who says it. */
    StatedCondition: {
      /** Name of the condition. */
      key: string;
      /** In SI, or a text. */
      value: string | number | null;
      /** file or you; assumed: a unit that was taken as proposed. */
      origin: string;
      /** Line or cell of the file; empty for the user's own. */
      where: string;
    };
    /** The experiment of one measurement of a request. */
    StatedExperiment: {
      /** Id as in the request. */
      id: string;
      /** Name of the file or preset. */
      name: string;
      /** Measurement kind. */
      kind: string;
      /** Its fields. */
      experiment: components["schemas"]["ExperimentField"][];
    };
    /** Figures of a step and back again on the nonlinear drive: the worse of the two. */
    StepFiguresAnswer: {
      /** Overshoot as a share of the step; null if the run failed. [1] */
      overshoot: number | null;
      /** Time until within 2 %; null where it does not settle. [s] */
      settling: number | null;
      /** Time from 10 to 90 %. [s] */
      rise: number | null;
      /** Share of the time with the command at its limits. [1] */
      saturated: number;
      /** Root mean square of the error as a share of the step. [1] */
      error: number | null;
      /** The same over the second half of its time. [1] */
      late_error: number | null;
      /** Whether the goals are met. */
      meets: boolean;
    };
    /** Second set point of a controlled antagonist joint: its stiffness, by the command that both muscles have in common. It is estimated from the angle and both pressures with the static model of the muscles; its error counts as the mean pressure that is missing, a share of the full one. */
    StiffnessControlInput: {
      /** Desired stiffness of the joint at constant pressures: a constant, or a signal of time. [N*m/rad] */
      reference: number | string | {
        /** Name of the shape. */
        shape: "step";
        /** When it steps. [s] */
        at?: number | string;
        /** The value after the step, inside the pulse, or in the first part of a period. [N*m/rad] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [N*m/rad] */
        initial?: number | string;
      } | {
        /** Name of the shape. */
        shape: "pulse";
        /** The value after the step, inside the pulse, or in the first part of a period. [N*m/rad] */
        level: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [N*m/rad] */
        initial?: number | string;
        /** When the pulse begins. [s] */
        on?: number | string;
        /** When the pulse ends. [s] */
        off: number | string;
      } | {
        /** Name of the shape. */
        shape: "square";
        /** The value after the step, inside the pulse, or in the first part of a period. [N*m/rad] */
        level?: number | string;
        /** The value before the step, outside the pulse, or in the second part of a period. [N*m/rad] */
        initial?: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** Share of each period with the first level. [1] */
        duty?: number | string;
        /** Peak to peak, the full height: level - initial. [N*m/rad] */
        amplitude?: number | string;
      } | {
        /** Name of the shape. */
        shape: "triangle";
        /** Peak to peak, the full height: offset to offset + amplitude. [N*m/rad] */
        amplitude: number | string;
        /** Duration of one period. [s] */
        period: number | string;
        /** The value that the amplitude is added to. [N*m/rad] */
        offset?: number | string;
      } | {
        /** Name of the shape. */
        shape: "ramp";
        /** The value before the ramp. [N*m/rad] */
        from?: number | string;
        /** The value after the ramp. [N*m/rad] */
        to: number | string;
        /** When the ramp begins. [s] */
        start?: number | string;
        /** How long the ramp lasts. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "sine";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [N*m/rad] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [N*m/rad] */
        offset?: number | string;
        /** Periods per second; or give the period. [Hz] */
        frequency?: number | string;
        /** Angle at t = 0. [rad] */
        phase?: number | string;
        /** Duration of one period. [s] */
        period?: number | string;
      } | {
        /** Name of the shape. */
        shape: "chirp";
        /** From the middle to the peak, half the height: offset - amplitude to offset + amplitude. [N*m/rad] */
        amplitude: number | string;
        /** The value that the amplitude is added to. [N*m/rad] */
        offset?: number | string;
        /** Frequency at the start. [Hz] */
        from: number | string;
        /** Frequency at the end of the duration and after it. [Hz] */
        to: number | string;
        /** How long the frequency changes. [s] */
        duration: number | string;
      } | {
        /** Name of the shape. */
        shape: "random";
        /** How long each level lasts. [s] */
        hold: number | string;
        /** Number that the levels follow from; the same seed gives the same levels. */
        seed?: number;
        /** Lowest level. [N*m/rad] */
        lower?: number | string;
        /** Highest level. [N*m/rad] */
        upper: number | string;
      } | {
        /** Name of the shape. */
        shape: "table";
        /** Instants of the points, ascending. [s] */
        times: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Values of the points, as many as instants. [N*m/rad] */
        values: (number | string)[] | {
          /** Unit of the values. */
          unit: string;
          /** The numbers. */
          values: number[];
        };
        /** Joined by lines, or each value held until the next. */
        interpolation?: "linear" | "hold";
      };
      /** Proportional gain. Default: 2 for a valve, 0 for a regulator. [1] */
      kp?: number | string | null;
      /** Integral gain, 1/s. Default: 0 for a valve, 0.5 for a regulator. [1/s] */
      ki?: number | string | null;
    };
    /** End stops as contraction ratios; below 0 the muscle may be stretched. */
    StopsInput: {
      /** The load rests here without pressure. [1] */
      min_contraction?: number | string;
      /** Default: the limit of the muscle preset, else 25 %. [1] */
      max_contraction?: number | string | null;
      /** Share of the speed with which the load rebounds from a stop; 0 = it does not. [1] */
      restitution?: number | string;
    };
    /** The pressure that lifts a load by a stroke. */
    StrokePressureQuestion: {
      /** The muscle. */
      muscle: components["schemas"]["MuscleInput"];
      /** The effects of its model; null: those of the preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Temperature of the muscle. [K] */
      temperature?: number | string;
      /** Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none. */
      direction?: -1 | 0 | 1;
      /** Asks for the pressure of a stroke. */
      question: "stroke_pressure";
      /** The load to lift. [N] */
      load: number | string;
      /** From the nominal length. [m] */
      stroke: number | string;
    };
    /** All runs of a study, and what they show; SI. */
    StudyAnswer: {
      /** Title of the study. */
      title: string;
      /** Name of the method. */
      method: string;
      /** Quantities and figures of the table. */
      columns: components["schemas"]["StudyColumnAnswer"][];
      /** Column -> values, one for each run that was made; also run, outcome and message. null where a figure does not exist; the message says why. */
      table: { [key: string]: (number | string | null)[] };
      /** How runs ended -> number of runs. */
      outcomes: { [key: string]: number };
      /** Each figure over all runs. */
      summary: components["schemas"]["StudyFigureSummary"][];
      /** Rank correlations; of random runs alone. */
      correlations: components["schemas"]["StudyCorrelation"][];
      /** Of the methods sobol and morris. */
      sensitivity: components["schemas"]["StudySensitivity"][];
      /** Numbers of the runs on the Pareto front; of one goal the best run; empty without goals. */
      front: number[];
      /** Of keeping the limits; of random runs alone. */
      probabilities: components["schemas"]["StudyProbability"][];
      /** Of a robust study, the most probable to keep all first. */
      designs: components["schemas"]["StudyDesign"][];
      /** Runs that were made. */
      runs: number;
      /** Runs of the plan. */
      planned: number;
      /** Runs that were kept from before and not made again. */
      kept: number;
      /** Figures of the goals. */
      goals: string[];
      /** Confidence level of all intervals. */
      confidence: number;
      /** Seed of the random numbers; null without. */
      seed: number | null;
      /** How the study ended. */
      outcome: "completed" | "timed_out" | "cancelled";
      /** Advice if the study did not complete. */
      message: string | null;
      /** Runs that failed, figures that are missing. */
      remarks: string[];
      /** Computing time in ms. */
      wall_ms: number;
    };
    /** A column of the table. */
    StudyColumnAnswer: {
      /** Key in the table: the path of the quantity or figure. */
      name: string;
      /** Whether it was varied or watched. */
      kind: "quantity" | "figure";
      /** SI unit; null for texts and plain numbers. */
      unit: string | null;
    };
    /** Spearman's rank correlation of a quantity and a figure. */
    StudyCorrelation: {
      /** Path of the figure. */
      figure: string;
      /** Name of the quantity. */
      quantity: string;
      /** -1 to 1; null where one of them does not vary. */
      rank_correlation: number | null;
    };
    /** A design of a robust study. */
    StudyDesign: {
      /** Its number in the plan. */
      design: number;
      /** Quantity -> value. */
      values: { [key: string]: number | string };
      /** Of each limit, then of all. */
      probabilities: components["schemas"]["StudyProbability"][];
    };
    /** A study: many runs of one subject with varied quantities. */
    StudyDocument: {
      /** Version of the document. */
      schema?: 1;
      /** Title for display. */
      title?: string;
      /** What is studied. */
      subject: components["schemas"]["Subject"];
      /** What is varied. */
      quantities: components["schemas"]["VariedQuantity"][];
      /** Figures to watch, besides those of goals and limits: timing.extend.rise_time and the other figures of the timing table, tracking.rms, largest.pressure, best.time. */
      figures?: string[];
      /** Goals, of an optimisation or for the Pareto front of the runs. */
      goals?: components["schemas"]["Goal"][];
      /** Limits of figures. */
      limits?: components["schemas"]["Limit"][];
      /** Which runs are made. */
      method: components["schemas"]["GridMethod"] | components["schemas"]["ListMethod"] | components["schemas"]["LatinHypercubeMethod"] | components["schemas"]["MonteCarloMethod"] | components["schemas"]["SobolMethod"] | components["schemas"]["MorrisMethod"] | components["schemas"]["OptimisationMethod"] | components["schemas"]["RobustMethod"];
      /** Confidence level of all intervals. */
      confidence?: number;
    };
    /** A value with its confidence interval. */
    StudyEstimate: {
      /** The value. */
      value: number | null;
      /** Lower end; null where the runs do not give one. */
      low: number | null;
      /** Upper end; null where the runs do not give one. */
      high: number | null;
    };
    /** A figure that can be watched. */
    StudyFigureOption: {
      /** Path of the figure. */
      path: string;
      /** SI unit. */
      unit: string;
    };
    /** A figure over all runs that have it. */
    StudyFigureSummary: {
      /** Path of the figure. */
      figure: string;
      /** Its SI unit. */
      unit: string;
      /** Runs that have it. */
      count: number;
      /** Runs that lack it. */
      missing: number;
      /** Mean, in the unit of the figure. */
      mean: components["schemas"]["StudyEstimate"] | null;
      /** Standard deviation, in the unit of the figure. */
      deviation: components["schemas"]["StudyEstimate"] | null;
      /** Smallest value, in the unit of the figure. */
      least: number | null;
      /** Largest value, in the unit of the figure. */
      most: number | null;
      /** Percent, 1 to 99 -> percentile, in the unit of the figure; its interval holds for any distribution. */
      percentiles: { [key: string]: components["schemas"]["StudyEstimate"] };
    };
    /** Influence of a quantity on a figure; each error is the half width of a confidence interval. */
    StudyInfluence: {
      /** Path of the figure. */
      figure: string;
      /** Name of the quantity. */
      quantity: string;
      /** Sobol: share of the variance due to the quantity alone. */
      first: number | null;
      /** Its error. */
      first_error: number | null;
      /** Sobol: share of the variance with all its interactions. */
      total: number | null;
      /** Its error. */
      total_error: number | null;
      /** Morris: mean elementary effect, in the unit of the figure. */
      mean: number | null;
      /** Morris: mean magnitude of the effects, in the unit of the figure. */
      mean_size: number | null;
      /** Its error. */
      mean_size_error: number | null;
      /** Morris: standard deviation of the effects, in the unit of the figure; large where the influence is not linear or depends on other quantities. */
      deviation: number | null;
    };
    /** What is kept of a study. */
    StudyKeptAnswer: {
      /** Runs that are kept from before. */
      runs: number;
    };
    /** What a study of a subject can vary and watch. */
    StudyOptionsAnswer: {
      /** What the subject is. */
      kind: "drive" | "task";
      /** Quantities, in the order of the document. */
      quantities: components["schemas"]["StudyQuantityOption"][];
      /** Figures. */
      figures: components["schemas"]["StudyFigureOption"][];
      /** The document of the subject with the effects of its presets stated. */
      document: { [key: string]: components["schemas"]["JsonValue"] };
      /** Whether the server can write tables as Parquet. */
      parquet: boolean;
    };
    /** Which subject. */
    StudyOptionsRequest: {
      /** What is to be studied. */
      subject: components["schemas"]["Subject"];
    };
    /** Share of the runs that keep a limit; one that failed does not keep it. */
    StudyProbability: {
      /** The figure of the limit, or 'all'. */
      what: string;
      /** Runs that keep it. */
      kept: number;
      /** All runs. */
      runs: number;
      /** kept / runs, with the interval of Clopper and Pearson. */
      probability: components["schemas"]["StudyEstimate"];
    };
    /** A quantity that can be varied. */
    StudyQuantityOption: {
      /** Path in the document of the subject. */
      path: string;
      /** SI unit. */
      unit: string;
      /** Present value in SI; null for a plain gain, whose unit the document does not state. */
      value: number | null;
    };
    /** Influences on a figure. */
    StudySensitivity: {
      /** Path of the figure. */
      figure: string;
      /** Of each quantity; empty with too few runs. */
      influences: components["schemas"]["StudyInfluence"][];
      /** Blocks of runs used; one with a failed run is left out. */
      blocks: number;
      /** Blocks of runs in the plan. */
      planned_blocks: number;
    };
    /** What is studied: a drive, a sizing task, or a saved model in a drive. */
    Subject: {
      /** A drive document or the id of a drive preset; with a model, the drive it is in. */
      drive?: components["schemas"]["DriveDocument"] | string | null;
      /** A sizing task or the id of a task preset; the figures are those of its first proposal. */
      task?: components["schemas"]["SizingTask"] | string | null;
      /** A saved model; its muscle and effects replace those of the drive. */
      model?: components["schemas"]["SavedModel"] | null;
    };
    /** The compressed-air supply. */
    SupplyInput: {
      /** Gauge pressure before the valve. [Pa] */
      pressure?: number | string;
    };
    /** A sheet, group or struct of a file. */
    TableOption: {
      /** Its name. */
      name: string;
      /** It is read now, alone or with others of the same columns. */
      is_read: boolean;
    };
    /** A sizing task to start from; its content is checked when it is used. */
    TaskAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a sizing task. */
      kind: "task";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** The document to start from. */
      document: { [key: string]: unknown };
      /** Path in the document -> source of the value. */
      grounds?: { [key: string]: components["schemas"]["Ground"] };
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** Parts that may be used. */
    TaskCatalogue: {
      /** Muscle presets. Default: all with complete catalogue data, because then every limit is known. */
      muscles?: string[] | null;
      /** Valve presets. Default: all switching and proportional valves with known flow. */
      valves?: string[] | null;
      /** Tube presets. Default: all. */
      tubes?: string[] | null;
      /** Tube length from the valve to each muscle; 0 for no tube. Default 1 m. [m] */
      tube_length?: number | string;
    };
    /** Limits of a drive. */
    TaskLimits: {
      /** Contraction at the end of the stroke. Default 20 %: makers allow 25 %, but there the force is small. A lower limit of the maker takes precedence. [1] */
      max_contraction?: number | string;
      /** Least excess of the static force over the load on the whole stroke, as a share of the load. Default 10 %: specimens differ by this much. [1] */
      force_reserve?: number | string;
      /** Unused share of the supply pressure. Default 0: its tolerance has a field of its own. [1] */
      pressure_reserve?: number | string;
      /** Installed length without pressure. Default 1 m. Longer muscles exist. [m] */
      max_length?: number | string;
      /** Length of both end fittings together. Default 0: no verified value is known. [m] */
      end_fittings?: number | string;
      /** Outside diameter at the end of the stroke. Leave empty for no limit. [m] */
      max_diameter?: number | string | null;
      /** Most parallel muscles. Default 2: more muscles rarely share a load evenly. */
      max_parallel?: number;
      /** Kinetic energy of the load at the end stop that the stop can take. Leave empty for no limit. A drive above it is proposed behind those below it. [J] */
      max_impact_energy?: number | string | null;
      /** Load cycles. Leave empty for no limit. Makers publish no curve; the program uses an unverified estimate (100 000 cycles at full force or contraction, 10 million without load). [1] */
      life?: number | string | null;
    };
    /** The load. All values are those at the load; forces are positive against the pull. */
    TaskLoad: {
      /** Mass moved by the muscle. 0 = no mass. [kg] */
      mass?: number | string;
      /** Angle between the motion and the horizontal. Default 90 deg: most loads hang. [rad] */
      inclination?: number | string;
      /** Constant force in addition to the weight. 0 = no force. [N] */
      force?: number | string;
      /** Additional force that depends on the stroke. Static calculations use it as it is; a simulation uses the lowest straight line that is nowhere below it and does not fall. */
      force_over_stroke?: components["schemas"]["ForceOverStroke"] | null;
      /** Spring against the contraction, relaxed at the start of the stroke. 0 = no spring. [N/m] */
      spring?: number | string;
      /** Mass on the other side of a pulley that pulls with the muscle. 0 = none. [kg] */
      counterweight?: number | string;
      /** Stroke of the muscle per stroke of the load. 1 = the muscle pulls directly. [1] */
      lever_ratio?: number | string;
      /** An antagonist pair on a pulley. No other field of the load may be given with it. */
      pair?: components["schemas"]["PairInput"] | null;
    };
    /** How the drive is used, for the cost of its air. */
    TaskOperation: {
      /** Cycles a year. Default one million. [1] */
      cycles_per_year?: number | string;
      /** Price of a cubic metre of compressed air at ANR. Default 0.025, a usual figure in euro (general knowledge, not verified: 0.01 to 0.03). [1/m^3] */
      air_price?: number | string;
      /** Currency of the price. */
      currency?: string;
    };
    /** Expected deviations of real drives from the calculation. */
    TaskUncertainty: {
      /** Two standard deviations of the blocked force between specimens. Default 10 %: published curves of the same size differ by this much. [1] */
      blocked_force?: number | string;
      /** Largest width of the loop, share of the nominal length. Default: that of the catalogue. [1] */
      hysteresis?: number | string | null;
      /** Largest deviation of the supply pressure. Default 3 %: a common service regulator. [1] */
      supply_pressure?: number | string;
      /** Simulated specimens of each proposal. 100 give the probability within 5 %. */
      specimens?: number;
    };
    /** The proposed term and the residual it explains, over one variable. */
    TermCurve: {
      /** The variable. */
      x: string;
      /** Its values, SI. */
      values: (number | null)[];
      /** The term there, SI. */
      term: (number | null)[];
      /** The residual that it is to explain, SI. */
      residual: (number | null)[];
    };
    /** The timing table of the first fill and the exhaust after it. */
    Timing: {
      /** Figures of one phase in SI: positioning_time [s], rise_time [s], delay_time [s], settling_time [s], average_speed [m/s], max_speed [m/s], max_speed_at [s], max_acceleration [m/s^2], max_acceleration_at [s], min_acceleration [m/s^2], min_acceleration_at [s], end_speed [m/s], impact_energy [J], overshoot [1], pressure_rise_time [s], pressure_delay_time [s], pressure_settling_time [s], air_mass [kg], air_volume_anr [m^3], tube_air_mass [kg], choked_share [1]. Speeds are magnitudes along the motion of the phase: shorter in extend, longer in retract. Accelerations are positive towards shorter in both phases, as in the columns. Null where it does not exist; see notes for the reason. */
      extend: { [key: string]: number | null };
      /** Figures of one phase in SI: positioning_time [s], rise_time [s], delay_time [s], settling_time [s], average_speed [m/s], max_speed [m/s], max_speed_at [s], max_acceleration [m/s^2], max_acceleration_at [s], min_acceleration [m/s^2], min_acceleration_at [s], end_speed [m/s], impact_energy [J], overshoot [1], pressure_rise_time [s], pressure_delay_time [s], pressure_settling_time [s], air_mass [kg], air_volume_anr [m^3], tube_air_mass [kg], choked_share [1]. Speeds are magnitudes along the motion of the phase: shorter in extend, longer in retract. Accelerations are positive towards shorter in both phases, as in the columns. Null where it does not exist; see notes for the reason. */
      retract: { [key: string]: number | null };
      /** "extend.rise_time" -> why it is null, or a remark on it. */
      notes: { [key: string]: string };
    };
    /** How far (+-) a fit may change a geometry value. */
    Tolerance: {
      /** Of the braid angle. */
      braid_angle?: components["schemas"]["Quantity"] | null;
      /** Of the braid diameter. */
      braid_diameter?: components["schemas"]["Quantity"] | null;
      /** Of the length between the fittings. */
      nominal_length?: components["schemas"]["Quantity"] | null;
      /** Of the wall of the bladder. */
      wall_thickness?: components["schemas"]["Quantity"] | null;
    };
    /** How well the position follows the reference. */
    TrackingAnswer: {
      /** Root mean square of the error over time. [m] */
      rms: number;
      /** Largest error. [m] */
      max: number;
      /** Delay with the best correlation; null if none fits. [s] */
      lag: number | null;
      /** Every step of the reference. */
      overshoot: components["schemas"]["Overshoot"][];
      /** Figure -> why it is null, or a remark on it. */
      notes: { [key: string]: string };
    };
    /** A controller, its steps on the nonlinear drive, and its margins on the primary model. */
    TrialAnswer: {
      /** Where the controller comes from. */
      name: "own" | "rule" | "refined";
      /** Its gains. */
      controller: components["schemas"]["ControllerAnswer"];
      /** Figures of its steps. */
      figures: components["schemas"]["StepFiguresAnswer"];
      /** Margins of its loop. */
      margins: components["schemas"]["MarginsAnswer"];
      /** When the step begins. [s] */
      begins: number;
      /** When the step back begins. [s] */
      returns: number;
      /** Instants of the run. [s] */
      time: number[];
      /** Reference. [m] */
      reference: (number | null)[];
      /** Position of the load. [m] */
      position: (number | null)[];
      /** Command. [1] */
      command: (number | null)[];
    };
    /** A density that rises linearly from the lower bound to the mode, and falls to the upper bound. */
    TriangularDistribution: {
      /** Kind of distribution. */
      type: "triangular";
      /** Lower bound. */
      least: number | string;
      /** Most probable value. */
      mode: number | string;
      /** Upper bound. */
      most: number | string;
    };
    /** A tube; its conductance is given for ``reference_length``. */
    TubeAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a tube. */
      kind: "tube";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Effect id -> parameter -> value: the effects that the model has by default. */
      effects?: { [key: string]: { [key: string]: components["schemas"]["Quantity"] } };
      /** Catalogue data, by name. */
      data?: { [key: string]: components["schemas"]["Quantity"] };
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** The tube between valve and muscle. */
    TubeInput: {
      /** Id of a tube preset; null: diameter and length are stated. */
      preset?: string | null;
      /** Bore of the tube. Default: that of the preset. [m] */
      inside_diameter?: number | string | null;
      /** Length of the tube. Default: that for which the preset is specified. [m] */
      length?: number | string | null;
    };
    /** Another effect that looks alike. */
    Twin: {
      /** Its id. */
      effect: string;
      /** The experiment that separates the two. */
      separated_by: string;
    };
    /** All values between two bounds are equally probable. */
    UniformDistribution: {
      /** Kind of distribution. */
      type: "uniform";
      /** Lower bound. */
      least: number | string;
      /** Upper bound. */
      most: number | string;
    };
    /** A column that nothing is read from. */
    UnreadColumn: {
      /** Header of the file. */
      column: string;
      /** Why nothing is read from it. */
      why: string;
    };
    /** A measurement and its use. */
    UsedMeasurement: {
      /** SHA-256 id of an uploaded file, or id of a preset measurement or reference curve. */
      id: string;
      /** Used for the fit, or only for validation. */
      use?: "fit" | "validation";
      /** What the user says about its experiment; takes precedence over the file. */
      experiment?: components["schemas"]["ExperimentInput"] | null;
    };
    /** The error of the model on measurements not used for the fit. */
    ValidationAnswer: {
      /** Root mean square of the residual. */
      rmse: number | null;
      /** RMSE over the largest measured magnitude. */
      nrmse_percent: number | null;
      /** Number of compared rows. */
      rows_used: number;
      /** The points, curve by curve. */
      series: components["schemas"]["ComparisonSeries"][];
    };
    /** A valve, or with ``regulator`` a pressure regulator; its conductances are needed to simulate it. */
    ValveAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a valve. */
      kind: "valve";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** Effect id -> parameter -> value: the effects that the model has by default. */
      effects?: { [key: string]: { [key: string]: components["schemas"]["Quantity"] } };
      /** Catalogue data, by name. */
      data?: { [key: string]: components["schemas"]["Quantity"] };
      /** What it does: "5/3-way proportional valve". */
      function: string;
      /** Figures of a pressure regulator; null of a valve. */
      regulator?: components["schemas"]["RegulatorPart"] | null;
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
    /** A valve preset, or flow values for filling and venting; values override those of the preset. */
    ValveInput: {
      /** Id of a valve or regulator preset; null: the flow values are stated. */
      preset?: string | null;
      /** Conductance of filling, ISO 6358. [m^3/(s*Pa)] */
      sonic_conductance?: number | string | null;
      /** Conductance of venting. Default: that of filling. [m^3/(s*Pa)] */
      exhaust_conductance?: number | string | null;
      /** Critical pressure ratio b of filling. Default: that of the preset, else 0.3. [1] */
      critical_pressure_ratio?: number | string | null;
      /** Critical pressure ratio of venting. Default: that of filling. [1] */
      exhaust_critical_pressure_ratio?: number | string | null;
      /** Standard nominal flow (6 to 5 bar gauge, normal litres) instead of a conductance. [m^3/s] */
      nominal_flow?: number | string | null;
    };
    /** The refined controller on a drive with another mass and supply. */
    VariationAnswer: {
      /** Factor of the mass. [1] */
      mass: number;
      /** Factor of the supply pressure. [1] */
      supply: number;
      /** Figures of its steps. */
      figures: components["schemas"]["StepFiguresAnswer"];
    };
    /** A quantity of the document that is varied: by values, over a range, or with a distribution. */
    VariedQuantity: {
      /** Path of the quantity in the document of the subject. */
      path: string;
      /** The values. For a field that is no quantity, e.g. the id of a preset, texts. */
      values?: (number | string)[] | null;
      /** Lower end of a range. */
      from?: number | string | null;
      /** Upper end of a range. */
      to?: number | string | null;
      /** Number of values of a range, for a grid and for designs of a robust study. */
      points?: number | null;
      /** How a range is divided, and how its values are distributed. */
      scale?: "linear" | "logarithmic";
      /** How the value is distributed. */
      distribution?: components["schemas"]["NormalDistribution"] | components["schemas"]["LognormalDistribution"] | components["schemas"]["UniformDistribution"] | components["schemas"]["TriangularDistribution"] | null;
      /** Whether the values are factors on the value in the document, e.g. 1 ± 0.05 for a tolerance; of a design in a robust study, on the value of the design. */
      relative?: boolean;
    };
    /** The verdict of the diagnosis. */
    Verdict: {
      /** The verdict as a word for programs: the model is at the noise (adequate); effects bring it there (missing_effects), some of which the data cannot tell from others (ambiguous); a rest with structure stays that no catalogued effect explains, or it is likelier that none of those named is missing (unknown_effect). */
      status: "adequate" | "missing_effects" | "ambiguous" | "unknown_effect";
      /** The status in words. */
      title: string;
      /** Ids of the missing effects. */
      effects: string[];
      /** Groups of effects that the data cannot distinguish. */
      indistinguishable: string[][];
      /** Effect -> probability that it, or one of its group, is missing; a group shares one. */
      probabilities: { [key: string]: number };
      /** Effect of the model that data cannot tell from others -> why this one was taken. */
      applied: { [key: string]: string };
      /** Effects that lower the error but are not called missing. */
      corrections: components["schemas"]["SmallCorrection"][];
      /** Share of the residual that is left to explain, 0 to 1. */
      unexplained_share: number;
      /** Variables that this part depends on. */
      unexplained_in: string[];
      /** What of it is periodic; null where nothing is beyond doubt, or no effect is unknown. */
      repeats: components["schemas"]["Repetition"] | null;
      /** A formula for it; null where none was proven. */
      proposed_term: components["schemas"]["ProposedTerm"] | null;
      /** Without a formula: the ranges in which the unexplained error is largest. */
      where_to_look: string | null;
      /** Recommended next measurement; null where none is needed. */
      next_measurement: string | null;
      /** For each pair of effects that the data cannot distinguish. */
      experiments: components["schemas"]["Experiment"][];
      /** For each group of effects that an experiment of this rig splits the best one, and a second one for the pairs that it leaves together; the group that is split best comes first. */
      next_experiments: components["schemas"]["NextExperiment"][];
      /** The verdict in one to four sentences. */
      sentence: string;
    };
    /** Whether the residual looks like noise. */
    WhitenessAnswer: {
      /** Autocorrelation of the residual at the lags 1, 2, ... within sweeps. */
      autocorrelation: (number | null)[];
      /** Half-width of the 95 % band of noise. */
      band: number;
      /** Share of the lags outside the band. */
      outside: number;
      /** Number of runs of one sign over that expected of noise. */
      runs: number;
      /** Few lags are outside the band, and the number of runs is that of noise. */
      white: boolean;
    };
    /** The stroke from the preload without pressure to the load at the highest pressure. The start is taken while venting and the end while filling, whatever ``direction`` is. */
    WorkingRangeQuestion: {
      /** The muscle. */
      muscle: components["schemas"]["MuscleInput"];
      /** The effects of its model; null: those of the preset. */
      effects?: { [key: string]: { [key: string]: number | string } } | null;
      /** Temperature of the muscle. [K] */
      temperature?: number | string;
      /** Sign of dL/dt, for friction: -1 filling (shortening), 1 venting, 0 none. */
      direction?: -1 | 0 | 1;
      /** Asks for the stroke between two loads. */
      question: "working_range";
      /** Load at the end of the stroke. [N] */
      load: number | string;
      /** The highest gauge pressure. [Pa] */
      pressure: number | string;
      /** Load at the start of the stroke. [N] */
      preload?: number | string;
    };
    /** A zero of the channel; of a complex pair the one with the positive imaginary part. */
    Zero: {
      /** Real part. [rad/s] */
      real: number;
      /** Imaginary part. [rad/s] */
      imaginary: number;
    };
    /** A position controller by a published rule, then refined on nonlinear runs. */
    mckibben__server__schemas__linearisations__DesignAnswer: {
      /** Goals, with the height of the step. */
      goals: components["schemas"]["GoalsAnswer"];
      /** Name and source of the rule. */
      rule: string;
      /** Gain at which a proportional loop oscillates. [1/m] */
      ultimate_gain: number | null;
      /** Period of that oscillation. [s] */
      ultimate_period: number | null;
      /** Own controller if there is one, rule, refined. */
      trials: components["schemas"]["TrialAnswer"][];
      /** Mass and supply 20 % lower and higher. */
      robust: components["schemas"]["VariationAnswer"][];
      /** Runs of the nonlinear drive. */
      evaluations: number;
      /** What to know about the design. */
      remarks: string[];
    };
    /** An example document of the Design view; its content is checked when it is used. */
    mckibben__server__schemas__presets__DesignAnswer: {
      /** Version of the document. */
      schema: 1;
      /** Says that it is a design. */
      kind: "design";
      /** Its id; for the user's own, also the name of its file. */
      id: string;
      /** Its name for display. */
      title: string;
      /** Who makes the part; empty where nobody does. */
      maker?: string;
      /** What it is, in a few sentences. */
      description?: string;
      /** Sources for further reading. */
      references?: string[];
      /** The document that the Design view opens. */
      document: { [key: string]: unknown };
      /** No figure is general knowledge (M) or an estimate (E). */
      verified: boolean;
      /** Part of the program, or saved by the user. */
      origin: "built-in" | "user";
    };
  };
}

export interface operations {
  /** A pressure, contraction, working range or stroke pressure, with the limits it crosses. */
  answer_question: {
    requestBody: { content: { "application/json": components["schemas"]["PressureQuestion"] | components["schemas"]["ContractionQuestion"] | components["schemas"]["WorkingRangeQuestion"] | components["schemas"]["StrokePressureQuestion"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["InverseAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The model's error on measurements, with or without a fit: figures, where it fails, the points. */
  compare_with_measurement: {
    requestBody: { content: { "application/json": components["schemas"]["ComparisonRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["ComparisonAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Force, stiffness, volume and diameter over the length for each pressure, and their limits. */
  compute_curves: {
    requestBody: { content: { "application/json": components["schemas"]["CurvesRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["CurvesAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** A copy with the last document and all measurements. */
  copy_project: {
    parameters: {
      path: { project_id: string };
    };
    requestBody: { content: { "application/json": components["schemas"]["ProjectCopy"] } };
    responses: {
      201: { content: { "application/json": components["schemas"]["ProjectAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** How many runs of a study are kept from before; asked again, it does not make them again. */
  count_kept_runs: {
    requestBody: { content: { "application/json": components["schemas"]["StudyDocument"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["StudyKeptAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Keep a document as a new project, with the measurements that it names and the table of its study. */
  create_project: {
    requestBody: { content: { "application/json": components["schemas"]["NewProject"] } };
    responses: {
      201: { content: { "application/json": components["schemas"]["ProjectAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Delete a measurement or preset; for 30 days it can be restored, unless its room is needed. */
  delete_kept: {
    parameters: {
      path: { kind: "files" | "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks"; identity: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["KeptAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Put a project into the bin, where it stays for 30 days; or erase it from there. */
  delete_project: {
    parameters: {
      path: { project_id: string };
      query: { erase?: boolean };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["ProjectInfo"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The experiment of each measurement of a diagnosis, before it is asked for. */
  describe_experiments: {
    requestBody: { content: { "application/json": components["schemas"]["DiagnosisRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["ExperimentAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Another title or other notes. */
  describe_project: {
    parameters: {
      path: { project_id: string };
    };
    requestBody: { content: { "application/json": components["schemas"]["ProjectChange"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["ProjectInfo"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The missing effects with reasons, twins, path and verdict; closing the connection ends the search. */
  diagnose_model: {
    requestBody: { content: { "application/json": components["schemas"]["DiagnosisRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["DiagnosisAnswer"]; "text/event-stream": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** What an effect leaves in the residual of each kind of test that shows it, on this muscle. */
  draw_signatures: {
    requestBody: { content: { "application/json": components["schemas"]["SignatureRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["SignatureAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** A project as one file, with its history, measurements and study tables. */
  export_project: {
    parameters: {
      path: { project_id: string };
    };
    responses: {
      200: { content: { "application/zip": Blob | ArrayBuffer | string } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Unpack a project of another machine as a new one, with its history, measurements and study tables. */
  import_project: {
    requestBody: { content: { "application/octet-stream": Blob | ArrayBuffer | string; "application/zip": Blob | ArrayBuffer | string } };
    responses: {
      201: { content: { "application/json": components["schemas"]["ProjectAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Keep a fitted model as a user preset, as it is, with the covariance and the range of its data. */
  keep_fitted_muscle: {
    requestBody: { content: { "application/json": components["schemas"]["FittedMuscleRequest"] } };
    responses: {
      201: { content: { "application/json": components["schemas"]["MuscleAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Linear models of a drive at an operating point; closing the connection ends sweep and design. */
  linearise_drive: {
    requestBody: { content: { "application/json": components["schemas"]["LinearisationRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["LinearisationAnswer"]; "text/event-stream": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Every effect with its equation, parameters, sources and what it is confused with. */
  list_effects: {
    responses: {
      200: { content: { "application/json": components["schemas"]["EffectsAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The formats in which a model or drive can be taken along. */
  list_formats: {
    responses: {
      200: { content: { "application/json": components["schemas"]["FormatsAnswer"] } };
    };
  };
  /** Measurements and presets of the user, those that can be restored, and what they take. */
  list_kept: {
    responses: {
      200: { content: { "application/json": components["schemas"]["KeptAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Every mystery with its story and start model; comparisons accept its measurement by id. */
  list_mysteries: {
    responses: {
      200: { content: { "application/json": components["schemas"]["Mystery"][] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** All presets of a kind with unit, source and grade of each figure, and the files that were refused. */
  list_presets: {
    parameters: {
      path: { kind: "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks" };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["PresetsAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** All projects, the one changed last first. */
  list_projects: {
    parameters: {
      query: { deleted?: boolean };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["ProjectsAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Quantities that a study of this subject can vary, with their values, and figures it can watch. */
  list_study_options: {
    requestBody: { content: { "application/json": components["schemas"]["StudyOptionsRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["StudyOptionsAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** A project; measurements and runs of studies that the server no longer has are stored again. */
  open_project: {
    parameters: {
      path: { project_id: string };
      query: { version?: number | null };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["ProjectAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** How a file would be read: columns, units, rows, kind, experiment. Nothing is stored. */
  preview_measurement: {
    parameters: {
      query: { name: string; mapping?: string | null; muscle?: string | null };
    };
    requestBody: { content: { "application/csv": Blob | ArrayBuffer | string; "application/octet-stream": Blob | ArrayBuffer | string; "application/vnd.ms-excel": Blob | ArrayBuffer | string; "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet": Blob | ArrayBuffer | string; "application/x-matlab-data": Blob | ArrayBuffer | string; "text/csv": Blob | ArrayBuffer | string; "text/plain": Blob | ArrayBuffer | string; "text/tab-separated-values": Blob | ArrayBuffer | string } };
    responses: {
      200: { content: { "application/json": components["schemas"]["PreviewAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Version of the server, what it does at the moment and how much memory it takes. */
  read_health: {
    responses: {
      200: { content: { "application/json": components["schemas"]["Health"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The versions of a project, the last one first; open one with ``?version=``. */
  read_history: {
    parameters: {
      path: { project_id: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["HistoryAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** A measurement with its columns in SI. */
  read_measurement: {
    parameters: {
      path: { measurement_id: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["MeasurementDetail"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Preset and length that an order code names, and what its parts mean. The field of an error names the part that is not understood by its place between the hyphens: ``code.2`` of ``DMSP-20-300X-RM`` is ``300X``. */
  read_order_code: {
    parameters: {
      path: { code: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["OrderCodeAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** One preset. */
  read_preset: {
    parameters: {
      path: { kind: "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks"; preset_id: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["MuscleAnswer"] | components["schemas"]["ValveAnswer"] | components["schemas"]["TubeAnswer"] | components["schemas"]["FittingAnswer"] | components["schemas"]["MeasurementPresetAnswer"] | components["schemas"]["CurvePresetAnswer"] | components["schemas"]["mckibben__server__schemas__presets__DesignAnswer"] | components["schemas"]["DriveAnswer"] | components["schemas"]["TaskAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Give a measurement or preset another name; its id stays. The answer is what is kept now. */
  rename_kept: {
    parameters: {
      path: { kind: "files" | "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks"; identity: string };
    };
    requestBody: { content: { "application/json": components["schemas"]["RenameRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["KeptAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Bring a deleted measurement or preset back. The answer is what is kept now. */
  restore_kept: {
    parameters: {
      path: { kind: "files" | "muscles" | "valves" | "tubes" | "fittings" | "measurements" | "curves" | "designs" | "drives" | "tasks"; identity: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["KeptAnswer"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Take a project out of the bin. */
  restore_project: {
    parameters: {
      path: { project_id: string };
    };
    responses: {
      200: { content: { "application/json": components["schemas"]["ProjectInfo"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The hidden effects of a mystery, compared with the user's diagnosis. */
  reveal_mystery: {
    parameters: {
      path: { mystery_id: string };
    };
    requestBody: { content: { "application/json": components["schemas"]["RevealRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["RevealAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Sweeps, Monte Carlo, sensitivities, optimisation, robust designs; at most 20 000 runs. Closing the connection ends the study. Its runs are kept: asked again, also after a restart of the server, it goes on from there, and a finished one answers at once. Longer studies: ``mckibben study``. */
  run_study: {
    requestBody: { content: { "application/json": components["schemas"]["StudyDocument"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["StudyAnswer"]; "text/event-stream": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Save a muscle as a user preset; replaces one of the same id, never a built-in one. */
  save_muscle: {
    requestBody: { content: { "application/json": components["schemas"]["MusclePreset"] } };
    responses: {
      201: { content: { "application/json": components["schemas"]["MuscleAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Save a further state; 409 where somebody else has saved since ``base_version``. */
  save_project: {
    parameters: {
      path: { project_id: string };
    };
    requestBody: { content: { "application/json": components["schemas"]["ProjectState"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["ProjectAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Motion, pressures, force, flows and timing table of a drive; closing the connection ends the run. */
  simulate_drive: {
    requestBody: { content: { "application/json": components["schemas"]["SimulationRequest"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["SimulationAnswer"]; "text/event-stream": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Ranked drives for a task, and rejected ones with reasons; closing the connection ends the search. */
  size_drives: {
    requestBody: { content: { "application/json": components["schemas"]["SizingTask"] } };
    responses: {
      200: { content: { "application/json": components["schemas"]["SizingAnswer"]; "text/event-stream": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** Upload a measurement file; the answer shows how it was read. The same file is stored once. With a mapping the measurement gets its own id, so that two readings of a file can be compared. */
  upload_measurement: {
    parameters: {
      query: { name: string; mapping?: string | null };
    };
    requestBody: { content: { "application/csv": Blob | ArrayBuffer | string; "application/octet-stream": Blob | ArrayBuffer | string; "application/vnd.ms-excel": Blob | ArrayBuffer | string; "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet": Blob | ArrayBuffer | string; "application/x-matlab-data": Blob | ArrayBuffer | string; "text/csv": Blob | ArrayBuffer | string; "text/plain": Blob | ArrayBuffer | string; "text/tab-separated-values": Blob | ArrayBuffer | string } };
    responses: {
      200: { content: { "application/json": components["schemas"]["MeasurementAnswer"] } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      409: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** A muscle, a fitted model or a drive in a format; the file names model, sources, range and gaps. */
  write_export: {
    requestBody: { content: { "application/json": components["schemas"]["ExportRequest"] } };
    responses: {
      200: { content: { "*/*": Blob | ArrayBuffer | string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The table of a study as Parquet, of the runs that are kept; none is made. Needs pyarrow where the server runs; ``/api/studies/options`` says whether it is there. */
  write_parquet: {
    requestBody: { content: { "application/json": components["schemas"]["StudyDocument"] } };
    responses: {
      200: { content: { "application/vnd.apache.parquet": Blob | ArrayBuffer | string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** The comparison and the diagnosis of a model as one file for archive and print. */
  write_report: {
    requestBody: { content: { "application/json": components["schemas"]["ReportRequest"] } };
    responses: {
      200: { content: { "text/html": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      404: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
  /** A new search, and one of its drives as a file for archive and print; disconnecting ends the search. */
  write_sizing_report: {
    requestBody: { content: { "application/json": components["schemas"]["SizingReportRequest"] } };
    responses: {
      200: { content: { "text/html": string } };
      400: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      403: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      413: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      415: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      422: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      429: { content: { "application/json": components["schemas"]["ErrorBody"] } };
      500: { content: { "application/json": components["schemas"]["ErrorBody"] } };
    };
  };
}
