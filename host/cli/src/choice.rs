//! Choices of the command line that are enums of the domain.

use clap::ValueEnum;

/// A choice of the command line that is an enum of the domain: the same variants, named as clap names them.
macro_rules! choice {
    (
        $(#[$doc:meta])* $name:ident => $domain:ty { $($(#[$variant_doc:meta])* $variant:ident),+ $(,)? }
        $(without $($left_out:ident),+)?
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        pub enum $name { $($(#[$variant_doc])* $variant),+ }

        impl From<$name> for $domain {
            fn from(choice: $name) -> Self {
                match choice { $($name::$variant => Self::$variant),+ }
            }
        }

        // Each value there is has a word here or is left out on purpose, or this does not compile.
        const _: fn($domain) = |value| match value {
            $(<$domain>::$variant)|+ $($(| <$domain>::$left_out)+)? => {}
        };
    };
}

choice! {
    /// Who sees a run or an object.
    VisibilityArg => ocb_service::model::Visibility {
        /// Only you.
        Private,
        /// Everyone who has the link.
        Unlisted,
        /// Everyone: an object is listed, and a run is on the board.
        Public,
    }
}

choice! {
    /// What to show.
    MeasureArg => ocb_service::model::Measure {
        /// Time per query.
        Time,
        /// Bounding volume tests per query.
        BvTests,
        /// Primitive tests per query.
        PrimitiveTests,
        /// Primitive tests per query in which the triangles of a vertex take part.
        TriangleTests,
        /// Configurations with their witness point at a vertex.
        Density,
        /// Share of wrong answers.
        Wrong,
        /// Share of missed collisions.
        Missed,
        /// Share of false alarms.
        FalseAlarms,
        /// Distance outside the certified interval, in u S.
        DistanceError,
        /// Share of configurations whose equivalent instances got contradictory answers.
        Flips,
        /// Share of the other algorithms whose answer contradicts this one.
        Disagreement,
    }
}
choice! {
    /// What counts as worse.
    WorstByArg => ocb_service::model::WorstBy {
        /// The longer time.
        Time,
        /// The larger error of the distance.
        Error,
    }
}
choice! {
    /// Which statistic.
    StatisticArg => ocb_core::statistics::Statistic {
        /// Arithmetic mean.
        Mean,
        /// Median.
        Median,
        /// Smallest.
        Min,
        /// Largest.
        Max,
        /// Standard deviation.
        StandardDeviation,
        /// Median absolute deviation.
        Mad,
    }
}
choice! {
    /// What happens to outliers.
    OutliersArg => ocb_core::statistics::Outliers {
        /// All values count.
        Keep,
        /// One fence per vertex.
        PerVertex,
        /// One fence over all configurations, as in the 2020 paper.
        Global,
    }
}
choice! {
    /// Which object.
    SideArg => ocb_service::model::Side {
        /// The fixed object.
        A,
        /// The moving object.
        B,
    }
}
choice! {
    /// Colours.
    ColormapArg => ocb_core::colormap::Colormap {
        /// As in the 2020 paper.
        Turbo,
        /// Perceptually uniform.
        Viridis,
        /// Reads the same with colour vision deficiency.
        Cividis,
    } without PurpleOrange
}
choice! {
    /// The order of the queries of a recording.
    OrderArg => ocb_service::model::Track {
        /// Pair by pair of objects, in another order in each process.
        Shuffled,
        /// Pair by pair, as recorded: algorithms may use that a query is like the one before.
        Recorded,
        /// All as recorded, to one process that has loaded every object once; for algorithms that offer `ocb.scene/1`.
        Scene,
    }
}
choice! {
    /// What to show on an object of a recording.
    ObjectMeasureArg => ocb_service::model::ObjectMeasure {
        /// Mean time per query.
        Time,
        /// Share of the answers that are wrong.
        Wrong,
        /// How many queries.
        Queries,
    }
}
choice! {
    /// How values are spread over the colours.
    ScaleArg => ocb_core::colormap::Scale {
        /// Evenly.
        Linear,
        /// By logarithm.
        Log,
    }
}
choice! {
    /// What to chart speed against.
    AccuracyArg => ocb_service::model::Accuracy {
        /// Share of wrong answers.
        Wrong,
        /// Share of missed collisions.
        Missed,
        /// Share of false alarms.
        FalseAlarms,
        /// Digits that the algorithm resolves, -log10 eps*.
        Digits,
        /// Worst error of a distance.
        Distance,
    }
}
choice! {
    /// What a chart shows.
    KindArg => ocb_service::model::ChartKind {
        /// Speed against accuracy.
        Accuracy,
        /// Mean and maximum time against distance.
        Distance,
        /// Mean and maximum time against triangle count.
        Triangles,
        /// Distribution of the time per query.
        Ecdf,
        /// Time against BV tests.
        BvTests,
        /// Time against primitive tests.
        PrimitiveTests,
        /// Share of wrong decisions against distance and margin.
        Resolution,
    }
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    On,
    Off,
}
